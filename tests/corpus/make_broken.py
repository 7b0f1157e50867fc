#!/usr/bin/env python3
"""Writes the corpus of broken scenes: tests/corpus/broken/CLASS/NAME.json and, beside that folder, the manifest
expected.tsv: file, path that the message must begin with, words that it must hold.

The files are committed, so that a changed reader meets the same bytes; this script says how they came about.
Run it from anywhere; it rewrites the corpus whole.
"""
import json
import pathlib

ROOT = pathlib.Path(__file__).resolve().parent / "broken"
EXPECTED = []


def write(cls, name, content, path, words):
    """One broken scene: `content` is bytes, text, or a value to be written as JSON."""
    if not isinstance(content, (str, bytes)):
        content = json.dumps(content, indent=1)
    if isinstance(content, str):
        content = content.encode()
    folder = ROOT / cls
    folder.mkdir(parents=True, exist_ok=True)
    (folder / f"{name}.json").write_bytes(content)
    EXPECTED.append((f"{cls}/{name}.json", path, words))


def scene(**more):
    return {"cairn": 1, **more}


def one_body(**body):
    return scene(bodies=[{"shapes": [{"kind": "sphere", "radius": 0.5}], **body}])


def one_shape(static=False, **shape):
    body = {"shapes": [shape]}
    if static:
        body["kind"] = "static"
    return scene(bodies=[body])


def sphere(**more):
    return one_shape(**{"kind": "sphere", "radius": 0.5, **more})


def box(**more):
    return one_shape(**{"kind": "box", "half_extents": [0.5, 0.5, 0.5], **more})


def raw_body(text):
    return '{"cairn": 1, "bodies": [{"shapes": [{"kind": "sphere", "radius": 0.5}], %s}]}' % text


def raw_sphere(radius):
    return '{"cairn": 1, "bodies": [{"shapes": [{"kind": "sphere", "radius": %s}]}]}' % radius


GOOD = json.dumps(scene(name="good", bodies=[{"name": "a", "position": [0, 1, 0],
                                              "shapes": [{"kind": "sphere", "radius": 0.5}]}]))

# Text that is no JSON.
write("empty", "nothing", "", "", "empty")
write("empty", "blanks", "   \n\t\n", "", "empty")
for i, cut in enumerate([1, 5, 10, 25, 40, 55, 70, 85, 100, len(GOOD) - 1]):
    write("truncated", f"after_{cut}", GOOD[:cut], "", "not valid JSON")
SYNTAX = {
    "trailing_comma": '{"cairn": 1,}', "missing_comma": '{"cairn": 1 "name": "x"}', "single_quotes": "{'cairn': 1}",
    "bare_key": "{cairn: 1}", "comment": '{"cairn": 1 /* one */}', "line_comment": '{"cairn": 1} // end',
    "two_values": '{"cairn": 1} {"cairn": 1}', "missing_colon": '{"cairn" 1}', "wrong_bracket": '{"cairn": 1]',
    "python_true": '{"cairn": 1, "world": {"sleeping": True}}', "leading_zero": '{"cairn": 01}',
    "plus_sign": '{"cairn": +1}', "bare_point": '{"cairn": 1, "duration": .5}',
    "ends_in_point": '{"cairn": 1, "duration": 5.}', "hexadecimal": '{"cairn": 0x1}', "words": "a ball on a floor",
    "raw_newline": '{"cairn": 1, "name": "a\nb"}', "bad_escape": '{"cairn": 1, "name": "a\\qb"}',
    "lone_surrogate": '{"cairn": 1, "name": "\\ud800"}', "xml": '<scene cairn="1"/>',
}
for name, text in SYNTAX.items():
    write("syntax", name, text, "", "not valid JSON")
UTF8 = {"lone_continuation": b"\x80", "overlong": b"\xc0\xaf", "cut_short": b"\xe2\x82", "surrogate": b"\xed\xa0\x80",
        "beyond_unicode": b"\xf5\x80\x80\x80", "latin_1": b"caf\xe9"}
for name, junk in UTF8.items():
    write("utf8", name, b'{"cairn": 1, "name": "' + junk + b'"}', "name", "UTF-8")
write("utf8", "utf16", '{"cairn": 1}'.encode("utf-16"), "", "not valid JSON")
write("utf8", "nul_bytes", b'{"cairn"\x00: 1}', "", "not valid JSON")
for name, token in {"nan": "NaN", "infinity": "Infinity", "minus_infinity": "-Infinity", "inf": "Inf"}.items():
    write("not_finite", name, raw_sphere(token), "bodies[0].shapes[0].radius", "finite numbers")
    write("not_finite", name + "_position", raw_body(f'"position": [0, {token}, 0]'), "bodies[0].position[1]",
          "finite numbers")
write("overflow", "double", raw_sphere("1e999"), "bodies[0].shapes[0].radius", "binary64")
write("overflow", "double_negative", raw_body('"gravity_scale": -1e400'), "bodies[0].gravity_scale", "binary64")
write("overflow", "float", raw_sphere("1e39"), "bodies[0].shapes[0].radius", "binary32")
write("overflow", "float_just", raw_sphere("3.4028236e38"), "bodies[0].shapes[0].radius", "binary32")
write("overflow", "float_velocity", one_body(linear_velocity=[0, -1e300, 0]), "bodies[0].linear_velocity[1]", "binary32")
write("overflow", "underflow", raw_sphere("1e-60"), "bodies[0].shapes[0].radius", "greater than 0")
write("overflow", "huge_integer", raw_body('"mass": ' + "9" * 60), "bodies[0].mass", "binary32")
write("overflow", "position", one_body(position=[0, 1e19, 0]), "bodies[0].position[1]", "1e18")

# The document's frame.
write("version", "missing", {"name": "x"}, "cairn", "required")
write("version", "two", {"cairn": 2}, "cairn", "found 2")
write("version", "zero", {"cairn": 0}, "cairn", "found 0")
write("version", "text", {"cairn": "1"}, "cairn", 'found "1"')
write("version", "fraction", {"cairn": 1.5}, "cairn", "found 1.5")
write("version", "null", {"cairn": None}, "cairn", "found null")
write("version", "true", {"cairn": True}, "cairn", "found true")
for name, value in {"array": [], "number": 1, "null": None, "true": True}.items():
    write("root", name, value, "", "an object with \"cairn\": 1")
write("root", "string", '"scene"', "", "an object with")
write("nesting", "arrays", '{"cairn": 1, "bodies": ' + "[" * 100 + "]" * 100 + "}", "", "nested")
write("nesting", "objects", '{"cairn": 1, "world": ' + '{"a":' * 100 + "1" + "}" * 100 + "}", "", "nested")
write("nesting", "thousands", "[" * 20000, "", "nested")

REPEATED = {
    "cairn": ('{"cairn": 1, "cairn": 1}', "cairn"),
    "name": ('{"cairn": 1, "name": "a", "name": "b"}', "name"),
    "bodies": ('{"cairn": 1, "bodies": [], "bodies": []}', "bodies"),
    "gravity": ('{"cairn": 1, "world": {"gravity": [0, 0, 0], "gravity": [0, -9, 0]}}', "world.gravity"),
    "dt": ('{"cairn": 1, "step": {"dt": 0.1, "solver": "xpbd", "dt": 0.2}}', "step.dt"),
    "mass": (raw_body('"mass": 1, "mass": 2'), "bodies[0].mass"),
    "radius": ('{"cairn": 1, "bodies": [{}, {"shapes": [{"kind": "sphere", "radius": 1, "radius": 2}]}]}',
               "bodies[1].shapes[0].radius"),
    "material": ('{"cairn": 1, "materials": {"ice": {}, "oak": {}, "ice": {}}}', "materials.ice"),
    "count": ('{"cairn": 1, "bodies": [{"repeat": {"count": [1,1,1], "count": [2,2,2]}}]}', "bodies[0].repeat.count"),
    "escaped": ('{"cairn": 1, "name": "a", "n\\u0061me": "b"}', "name"),
}
for name, (text, path) in REPEATED.items():
    write("repeated_key", name, text, path, "more than once")

MISSPELT = {
    "root_bodys": (scene(bodys=[]), "bodys", '"bodies"'),
    "root_wrold": (scene(wrold={}), "wrold", '"world"'),
    "root_steps": (scene(steps={}), "steps", '"step"'),
    "root_camara": (scene(camara={}), "camara", '"camera"'),
    "root_material": (scene(material={}), "material", '"materials"'),
    "gravty": (scene(world={"gravty": [0, 0, 0]}), "world.gravty", '"gravity"'),
    "sleep": (scene(world={"sleep": True}), "world.sleep", '"sleeping"'),
    "substep": (scene(step={"substep": 4}), "step.substep", '"substeps"'),
    "narrowphase": (scene(step={"narrowphase": "sat"}), "step.narrowphase", '"narrow_phase"'),
    "broad_hyphen": (scene(step={"broad-phase": "brute-force"}), "step.broad-phase", '"broad_phase"'),
    "frictoin": (scene(materials={"ice": {"frictoin": 0}}), "materials.ice.frictoin", '"friction"'),
    "postion": (one_body(postion=[0, 0, 0]), "bodies[0].postion", '"position"'),
    "linear_velocty": (one_body(linear_velocty=[0, 0, 0]), "bodies[0].linear_velocty", '"linear_velocity"'),
    "camel": (one_body(angularVelocity=[0, 0, 0]), "bodies[0].angularVelocity", '"angular_velocity"'),
    "capital": (one_body(Name="a"), "bodies[0].Name", '"name"'),
    "rotations": (one_body(rotations=[0, 0, 0, 1]), "bodies[0].rotations", '"rotation"'),
    "shape": (scene(bodies=[{"shape": []}]), "bodies[0].shape", '"shapes"'),
    "halfextents": (one_shape(kind="box", halfextents=[1, 1, 1]), "bodies[0].shapes[0].halfextents", '"half_extents"'),
    "raduis": (one_shape(kind="sphere", raduis=1), "bodies[0].shapes[0].raduis", '"radius"'),
    "densty": (sphere(densty=10), "bodies[0].shapes[0].densty", '"density"'),
    "spacng": (scene(bodies=[{"repeat": {"count": [1, 1, 1], "spacng": [1, 1, 1]}, "body": {}}]),
               "bodies[0].repeat.spacng", '"spacing"'),
    "ey": (scene(camera={"ey": [0, 0, 0]}), "camera.ey", '"eye"'),
    "inerta": (one_body(mass_properties={"mass": 1, "inerta": [1, 1, 1, 0, 0, 0]}), "bodies[0].mass_properties.inerta",
               '"inertia"'),
    "catgory": (one_body(collision={"catgory": 1}), "bodies[0].collision.catgory", '"category"'),
    "degree": (one_body(rotation={"axis": [0, 1, 0], "degree": 5}), "bodies[0].rotation.degree", '"degrees"'),
}
for name, (value, path, near) in MISSPELT.items():
    write("misspelt_key", name, value, path, "did you mean " + near)
UNKNOWN = {
    "root": (scene(author="me"), "author"), "world": (scene(world={"wind": 3}), "world.wind"),
    "body_color": (one_body(color="red"), "bodies[0].color"),
    "sphere_half_extents": (sphere(half_extents=[1, 1, 1]), "bodies[0].shapes[0].half_extents"),
    "box_radius": (box(radius=1), "bodies[0].shapes[0].radius"),
    "plane_radius": (one_shape(static=True, kind="plane", normal=[0, 1, 0], radius=1), "bodies[0].shapes[0].radius"),
    "capsule_half_extents": (one_shape(kind="capsule", radius=1, height=1, half_extents=[1, 1, 1]), "bodies[0].shapes[0].half_extents"),
    "sphere_rounding": (sphere(rounding=0.1), "bodies[0].shapes[0].rounding"),
    "beside_repeat": (scene(bodies=[{"repeat": {"count": [1, 1, 1], "spacing": [1, 1, 1]}, "body": {}, "mass": 1}]),
                      "bodies[0].mass"),
    "empty_key": (scene(**{"": 1}), '""'),
}
for name, (value, path) in UNKNOWN.items():
    write("unknown_key", name, value, path, "unknown key")

# Values of the wrong kind.
TYPES = {
    "name_number": (scene(name=3), "name", "a string"), "duration_text": (scene(duration="10"), "duration", "at least 0"),
    "duration_null": (scene(duration=None), "duration", "at least 0"), "world_array": (scene(world=[]), "world", "an object"),
    "world_null": (scene(world=None), "world", "an object"), "step_text": (scene(step="xpbd"), "step", "an object"),
    "materials_array": (scene(materials=[]), "materials", "an object"),
    "material_number": (scene(materials={"ice": 0.02}), "materials.ice", "an object"),
    "bodies_object": (scene(bodies={}), "bodies", "an array"), "body_text": (scene(bodies=["ball"]), "bodies[0]", "an object"),
    "body_null": (scene(bodies=[None]), "bodies[0]", "an object"), "joints_object": (scene(joints={}), "joints", "an array"),
    "camera_array": (scene(camera=[[1, 1, 1], [0, 0, 0]]), "camera", "an object"),
    "gravity_number": (scene(world={"gravity": -9.81}), "world.gravity", "an array of 3"),
    "sleeping_number": (scene(world={"sleeping": 1}), "world.sleeping", "true or false"),
    "dt_text": (scene(step={"dt": "1/60"}), "step.dt", "seconds"), "solver_number": (scene(step={"solver": 1}), "step.solver", "a string"),
    "substeps_fraction": (scene(step={"substeps": 2.5}), "step.substeps", "whole number"),
    "iterations_text": (scene(step={"iterations": "10"}), "step.iterations", "whole number"),
    "body_name_array": (one_body(name=["a"]), "bodies[0].name", "a string"),
    "position_two": (one_body(position=[0, 1]), "bodies[0].position", "an array of 3"),
    "position_four": (one_body(position=[0, 1, 2, 3]), "bodies[0].position", "an array of 3"),
    "position_object": (one_body(position={"x": 0, "y": 1, "z": 2}), "bodies[0].position", "an array of 3"),
    "position_text": (one_body(position=[0, "1", 0]), "bodies[0].position[1]", "a number"),
    "position_null": (one_body(position=[0, None, 0]), "bodies[0].position[1]", "metres"),
    "velocity_true": (one_body(linear_velocity=[True, 0, 0]), "bodies[0].linear_velocity[0]", "a finite number"),
    "rotation_three": (one_body(rotation=[0, 90, 0]), "bodies[0].rotation", "a quaternion"),
    "rotation_number": (one_body(rotation=90), "bodies[0].rotation", "a quaternion"),
    "gyroscopic_text": (one_body(gyroscopic="yes"), "bodies[0].gyroscopic", "true or false"),
    "can_sleep_null": (one_body(can_sleep=None), "bodies[0].can_sleep", "true or false"),
    "continuous_number": (one_body(continuous=0), "bodies[0].continuous", "true or false"),
    "mass_text": (one_body(mass="1 kg"), "bodies[0].mass", "greater than 0"),
    "shapes_object": (scene(bodies=[{"shapes": {"kind": "sphere", "radius": 1}}]), "bodies[0].shapes", "an array"),
    "shape_text": (scene(bodies=[{"shapes": ["sphere"]}]), "bodies[0].shapes[0]", "an object"),
    "kind_number": (one_shape(kind=1), "bodies[0].shapes[0].kind", "a string"),
    "radius_text": (one_shape(kind="sphere", radius="big"), "bodies[0].shapes[0].radius", "greater than 0"),
    "half_extents_number": (one_shape(kind="box", half_extents=1), "bodies[0].shapes[0].half_extents", "an array of 3"),
    "material_object": (sphere(material={"friction": 1}), "bodies[0].shapes[0].material", "a string"),
    "lock_text": (one_body(lock="xyz"), "bodies[0].lock", "an array"), "lock_number": (one_body(lock=[1]), "bodies[0].lock[0]", "a string"),
    "category_text": (one_body(collision={"category": "all"}), "bodies[0].collision.category", "whole number"),
    "sensor_text": (sphere(sensor="no"), "bodies[0].shapes[0].sensor", "true or false"),
    "inertia_three": (one_body(mass_properties={"mass": 1, "inertia": [1, 1, 1]}), "bodies[0].mass_properties.inertia", "6 numbers"),
    "repeat_number": (scene(bodies=[{"repeat": 3, "body": {}}]), "bodies[0].repeat", "an object"),
}
TYPES["position_text"] = (TYPES["position_text"][0], "bodies[0].position[1]", "metres")
for name, (value, path, words) in TYPES.items():
    write("wrong_type", name, value, path, words)

MISSING = {
    "shape_kind": (one_shape(radius=1), "bodies[0].shapes[0].kind"), "radius": (one_shape(kind="sphere"), "bodies[0].shapes[0].radius"),
    "half_extents": (one_shape(kind="box"), "bodies[0].shapes[0].half_extents"),
    "capsule_radius": (one_shape(kind="capsule", height=1), "bodies[0].shapes[0].radius"),
    "capsule_height": (one_shape(kind="capsule", radius=1), "bodies[0].shapes[0].height"),
    "normal": (one_shape(static=True, kind="plane", offset=0), "bodies[0].shapes[0].normal"),
    "axis": (one_body(rotation={"degrees": 5}), "bodies[0].rotation.axis"),
    "degrees": (one_body(rotation={"axis": [0, 1, 0]}), "bodies[0].rotation.degrees"),
    "properties_mass": (one_body(mass_properties={"inertia": [1, 1, 1, 0, 0, 0]}), "bodies[0].mass_properties.mass"),
    "properties_inertia": (one_body(mass_properties={"mass": 1}), "bodies[0].mass_properties.inertia"),
    "repeat_body": (scene(bodies=[{"repeat": {"count": [1, 1, 1], "spacing": [1, 1, 1]}}]), "bodies[0].body"),
    "body_repeat": (scene(bodies=[{"body": {}}]), "bodies[0].repeat"),
    "count": (scene(bodies=[{"repeat": {"spacing": [1, 1, 1]}, "body": {}}]), "bodies[0].repeat.count"),
    "spacing": (scene(bodies=[{"repeat": {"count": [1, 1, 1]}, "body": {}}]), "bodies[0].repeat.spacing"),
}
for name, (value, path) in MISSING.items():
    write("missing_key", name, value, path, "required")

# Numbers that make no sense where they stand.
RANGES = {
    "duration": (scene(duration=-1), "duration"), "threshold": (scene(world={"restitution_threshold": -1}), "world.restitution_threshold"),
    "dt_zero": (scene(step={"dt": 0}), "step.dt"), "dt_negative": (scene(step={"dt": -0.01}), "step.dt"),
    "dt_huge": (scene(step={"dt": 1e6}), "step.dt"), "substeps_zero": (scene(step={"substeps": 0}), "step.substeps"),
    "substeps_many": (scene(step={"substeps": 100000}), "step.substeps"), "iterations_negative": (scene(step={"iterations": -1}), "step.iterations"),
    "friction": (scene(materials={"ice": {"friction": -0.1}}), "materials.ice.friction"),
    "restitution_low": (sphere(restitution=-0.5), "bodies[0].shapes[0].restitution"),
    "restitution_high": (sphere(restitution=1.1), "bodies[0].shapes[0].restitution"),
    "rolling": (sphere(rolling_friction=-1), "bodies[0].shapes[0].rolling_friction"),
    "spinning": (sphere(spinning_friction=-1), "bodies[0].shapes[0].spinning_friction"),
    "radius_zero": (one_shape(kind="sphere", radius=0), "bodies[0].shapes[0].radius"),
    "radius_negative": (one_shape(kind="sphere", radius=-1), "bodies[0].shapes[0].radius"),
    "capsule_radius_zero": (one_shape(kind="capsule", radius=0, height=1), "bodies[0].shapes[0].radius"),
    "capsule_height_negative": (one_shape(kind="capsule", radius=1, height=-1), "bodies[0].shapes[0].height"),
    "extent_zero": (one_shape(kind="box", half_extents=[1, 0, 1]), "bodies[0].shapes[0].half_extents[1]"),
    "extent_negative": (one_shape(kind="box", half_extents=[1, 1, -1]), "bodies[0].shapes[0].half_extents[2]"),
    "density_zero": (sphere(density=0), "bodies[0].shapes[0].density"), "density_negative": (sphere(density=-1000), "bodies[0].shapes[0].density"),
    "linear_damping": (one_body(linear_damping=-1), "bodies[0].linear_damping"),
    "angular_damping": (one_body(angular_damping=-1), "bodies[0].angular_damping"),
    "category": (one_body(collision={"category": -1}), "bodies[0].collision.category"),
    "mask": (one_body(collision={"mask": 4294967296}), "bodies[0].collision.mask"),
    "group": (one_body(collision={"group": 3000000000}), "bodies[0].collision.group"),
    "degrees": (one_body(rotation={"axis": [0, 1, 0], "degrees": 1e9}), "bodies[0].rotation.degrees"),
    "rounding": (box(rounding=-0.1), "bodies[0].shapes[0].rounding"),
    "jitter": (scene(bodies=[{"repeat": {"count": [1, 1, 1], "spacing": [1, 1, 1], "jitter": -1}, "body": {}}]), "bodies[0].repeat.jitter"),
    "seed": (scene(bodies=[{"repeat": {"count": [1, 1, 1], "spacing": [1, 1, 1], "seed": -7}, "body": {}}]), "bodies[0].repeat.seed"),
}
for name, (value, path) in RANGES.items():
    write("out_of_range", name, value, path, "allowed:")
write("zero_length", "quaternion", one_body(rotation=[0, 0, 0, 0]), "bodies[0].rotation", "length 0")
write("zero_length", "shape_quaternion", sphere(rotation=[0, 0, 0, 0]), "bodies[0].shapes[0].rotation", "length 0")
write("zero_length", "axis", one_body(rotation={"axis": [0, 0, 0], "degrees": 5}), "bodies[0].rotation.axis", "length 0")
write("zero_length", "normal", one_shape(static=True, kind="plane", normal=[0, 0, 0]), "bodies[0].shapes[0].normal", "length 0")
write("zero_length", "camera", scene(camera={"eye": [1, 2, 3], "target": [1, 2, 3]}), "camera", "two points")


def inertia(entries):
    return one_body(mass_properties={"mass": 1, "inertia": entries})


AT = "bodies[0].mass_properties.inertia"
for name, entries in {"zero": [0, 0, 0, 0, 0, 0], "negative": [1, -1, 1, 0, 0, 0], "one_zero": [1, 1, 0, 0, 0, 0],
                      "large_product": [1, 1, 1, 2, 0, 0], "singular": [1, 1, 2, 1, 0, 0]}.items():
    write("inertia", name, inertia(entries), AT, "positive definite")
for name, entries in {"triangle_z": [1, 1, 3, 0, 0, 0], "triangle_x": [5, 1, 1, 0, 0, 0],
                      "triangle_turned": [2.5, 2.5, 1, 1.5, 0, 0]}.items():
    write("inertia", name, inertia(entries), AT, "triangle inequality")

MASS = {
    "zero": (one_body(mass=0), "bodies[0].mass", "greater than 0"), "negative": (one_body(mass=-5), "bodies[0].mass", "greater than 0"),
    "both": (one_body(mass=1, mass_properties={"mass": 1, "inertia": [1, 1, 1, 0, 0, 0]}), "bodies[0].mass_properties", "one of the two"),
    "none": (scene(bodies=[{}]), "bodies[0]", "without mass"), "no_shapes": (scene(bodies=[{"shapes": []}]), "bodies[0]", "without mass"),
    "mass_without_shapes": (scene(bodies=[{"mass": 3}]), "bodies[0]", "without mass"),
    "in_repeat": (scene(bodies=[{"repeat": {"count": [2, 2, 2], "spacing": [1, 1, 1]}, "body": {"mass": -1}}]), "bodies[0].body.mass", "greater than 0"),
    "properties_zero": (one_body(mass_properties={"mass": 0, "inertia": [1, 1, 1, 0, 0, 0]}), "bodies[0].mass_properties.mass", "greater than 0"),
}
for name, (value, path, words) in MASS.items():
    write("mass", name, value, path, words)
PLANE = {"kind": "plane", "normal": [0, 1, 0]}
write("plane", "dynamic", scene(bodies=[{"shapes": [PLANE]}]), "bodies[0].shapes[0].kind", "static bodies")
write("plane", "kinematic", scene(bodies=[{"kind": "kinematic", "shapes": [PLANE]}]), "bodies[0].shapes[0].kind", "static bodies")
write("plane", "second_shape", scene(bodies=[{"shapes": [{"kind": "sphere", "radius": 1}, PLANE]}]), "bodies[0].shapes[1].kind", "static bodies")

BALL = {"shapes": [{"kind": "sphere", "radius": 0.5}]}
NAMES = {
    "twice": (scene(bodies=[{"name": "a", **BALL}, {"name": "b", **BALL}, {"name": "a", **BALL}]), "bodies[2].name"),
    "as_unnamed": (scene(bodies=[BALL, {"name": "body[0]", **BALL}]), "bodies[1].name"),
    "as_later_unnamed": (scene(bodies=[{"name": "body[1]", **BALL}, BALL]), "bodies[0].name"),
    "as_copy": (scene(bodies=[{"repeat": {"count": [2, 2, 2], "spacing": [2, 2, 2]}, "body": {"name": "c", **BALL}}, {"name": "c[1,0,1]", **BALL}]), "bodies[1].name"),
    "two_repeats": (scene(bodies=[{"repeat": {"count": [1, 1, 1], "spacing": [1, 1, 1]}, "body": {"name": "c", **BALL}}] * 2), "bodies[1].body.name"),
    "as_unnamed_copy": (scene(bodies=[{"repeat": {"count": [3, 1, 1], "spacing": [2, 2, 2]}, "body": BALL}, {"name": "body[2]", **BALL}]), "bodies[1].name"),
}
for name, (value, path) in NAMES.items():
    write("duplicate_name", name, value, path, "unique")
write("empty_name", "body", one_body(name=""), "bodies[0].name", "at least one character")
write("empty_name", "material", scene(materials={"": {}}), 'materials.""', "at least one character")

write("unknown_name", "material_none", sphere(material="ice"), "bodies[0].shapes[0].material", "no material of this scene")
write("unknown_name", "material_misspelt", scene(materials={"rubber": {}}, bodies=[{"shapes": [{"kind": "sphere", "radius": 1, "material": "ruber"}]}]),
      "bodies[0].shapes[0].material", 'did you mean "rubber"')
write("unknown_name", "material_case", scene(materials={"Ice": {}}, bodies=[{"shapes": [{"kind": "sphere", "radius": 1, "material": "ice"}]}]),
      "bodies[0].shapes[0].material", 'did you mean "Ice"')
for key, value in {"friction": 0.5, "restitution": 0.5, "rolling_friction": 0, "spinning_friction": 0, "surface_velocity": [1, 0, 0]}.items():
    write("material_twice", key, scene(materials={"ice": {}}, bodies=[{"shapes": [{"kind": "sphere", "radius": 1, "material": "ice", key: value}]}]),
          f"bodies[0].shapes[0].{key}", "not both")
WORDS = {
    "body_kind": (one_body(kind="dynamc"), "bodies[0].kind", 'did you mean "dynamic"'), "body_kind_fixed": (one_body(kind="fixed"), "bodies[0].kind", "static, kinematic, dynamic"),
    "shape_kind": (one_shape(kind="spere"), "bodies[0].shapes[0].kind", 'did you mean "sphere"'),
    "shape_kind_cube": (one_shape(kind="cube"), "bodies[0].shapes[0].kind", "sphere, box, capsule, plane"),
    "shape_kind_case": (one_shape(kind="Box"), "bodies[0].shapes[0].kind", 'did you mean "box"'),
    "solver": (scene(step={"solver": "sequential_impulse"}), "step.solver", 'did you mean "sequential-impulse"'),
    "solver_pgs": (scene(step={"solver": "pgs"}), "step.solver", "soft-step, sequential-impulse, xpbd"),
    "narrow_phase": (scene(step={"narrow_phase": "gjk"}), "step.narrow_phase", "sat, gjk-epa"),
    "broad_phase": (scene(step={"broad_phase": "brute"}), "step.broad_phase", "tree, brute-force"),
    "lock": (one_body(lock=["x", "w"]), "bodies[0].lock[1]", "x, y, z, rx, ry, rz"), "lock_twice": (one_body(lock=["x", "x"]), "bodies[0].lock[1]", "each axis once"),
    "lock_case": (one_body(lock=["X"]), "bodies[0].lock[0]", "x, y, z"),
}
for name, (value, path, words) in WORDS.items():
    write("unknown_word", name, value, path, words)


def repeat(count, **more):
    return scene(bodies=[{"repeat": {"count": count, "spacing": [2, 2, 2], **more}, "body": BALL}])


REPEAT = {
    "zero": (repeat([1, 0, 1]), "bodies[0].repeat.count[1]", "whole number"), "negative": (repeat([1, 1, -4]), "bodies[0].repeat.count[2]", "whole number"),
    "fraction": (repeat([1.5, 1, 1]), "bodies[0].repeat.count[0]", "whole number"), "two": (repeat([3, 3]), "bodies[0].repeat.count", "3 whole numbers"),
    "number": (repeat(8), "bodies[0].repeat.count", "3 whole numbers"), "huge_axis": (repeat([10000001, 1, 1]), "bodies[0].repeat.count[0]", "whole number"),
    "huge_product": (repeat([1000, 1000, 1000]), "bodies[0].repeat.count", "at most 10000000"),
    "overflowing": (repeat([10000000, 10000000, 10000000]), "bodies[0].repeat.count", "at most 10000000"),
    "two_together": (scene(bodies=[repeat([1000, 1000, 6])["bodies"][0], repeat([1000, 1000, 5])["bodies"][0]]), "bodies[1]", "at most 10000000"),
    "nested": (scene(bodies=[{"repeat": {"count": [2, 2, 2], "spacing": [2, 2, 2]}, "body": repeat([2, 2, 2])["bodies"][0]}]), "bodies[0].body.repeat", "unknown key"),
    "seed_fraction": (repeat([1, 1, 1], seed=0.5), "bodies[0].repeat.seed", "whole number"),
    "seed_huge": (repeat([1, 1, 1], seed=2**64), "bodies[0].repeat.seed", "whole number"),
}
for name, (value, path, words) in REPEAT.items():
    write("repeat", name, value, path, words)

SHAPES = {
    "cylinder": {"radius": 1, "height": 1}, "cone": {"radius": 1, "height": 1}, "ellipsoid": {"radii": [1, 2, 3]},
    "hull": {"points": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]}, "compound": {"children": [{"kind": "sphere", "radius": 1}]},
    "mesh": {"vertices": [[0, 0, 0], [1, 0, 0], [0, 0, 1]], "triangles": [[0, 2, 1]]}, "height_field": {"heights": [[0, 0], [0, 0]], "cell_size": [1, 1]},
}
for kind, fields in SHAPES.items():
    write("not_yet_shape", kind, one_shape(static=True, kind=kind, **fields), "bodies[0].shapes[0].kind", "not yet supported")
write("not_yet_shape", "rounding", box(rounding=0.1), "bodies[0].shapes[0].rounding", "not yet supported")
write("not_yet_shape", "sensor", sphere(sensor=True), "bodies[0].shapes[0].sensor", "not yet supported")
for kind in ["ball", "hinge", "distance", "slider", "weld"]:
    write("not_yet_joint", kind, scene(bodies=[{"name": "a", **BALL}], joints=[{"kind": kind, "bodies": ["a", None], "anchor": [0, 1, 0]}]),
          "joints[0].kind", f'"{kind}" is not yet supported')
for solver in ["avbd"]:
    write("not_yet_step", solver, scene(step={"solver": solver}), "step.solver", "not yet supported")


def main():
    listing = "".join("\t".join(row) + "\n" for row in sorted(EXPECTED))
    (ROOT.parent / "expected.tsv").write_text(listing)
    kept = {row[0] for row in EXPECTED}
    for old in ROOT.glob("*/*.json"):
        if str(old.relative_to(ROOT)) not in kept:
            old.unlink()
    print(f"{len(EXPECTED)} files in {len({row[0].split('/')[0] for row in EXPECTED})} classes")


if __name__ == "__main__":
    main()
