// Which body is under the pointer? Each shape's closed form against the ray, in the shape's own
// frame.
"use strict";
(function (cairn) {
  function hit_sphere(origin, direction, radius) {
    const b = origin.dot(direction),
      c = origin.lengthSq() - radius * radius,
      root = b * b - c;
    if (root < 0) return Infinity;
    const near = -b - Math.sqrt(root);
    return near > 0 ? near : Infinity;
  }

  function hit_box(origin, direction, half) {
    let enter = -Infinity,
      leave = Infinity;
    for (const [i, axis] of ["x", "y", "z"].entries()) {
      const inverse = 1 / direction[axis];
      const a = (-half[i] - origin[axis]) * inverse,
        b = (half[i] - origin[axis]) * inverse;
      enter = Math.max(enter, Math.min(a, b));
      leave = Math.min(leave, Math.max(a, b));
    }
    return enter > 0 && enter <= leave ? enter : Infinity;
  }

  // The side alone: the balls at its ends are shapes of their own.
  function hit_barrel(origin, direction, [radius, half]) {
    const a = direction.x * direction.x + direction.z * direction.z,
      b = origin.x * direction.x + origin.z * direction.z,
      c = origin.x * origin.x + origin.z * origin.z - radius * radius,
      root = b * b - a * c;
    if (root < 0 || a === 0) return Infinity;
    const near = (-b - Math.sqrt(root)) / a;
    return near > 0 && Math.abs(origin.y + near * direction.y) <= half ? near : Infinity;
  }

  // How far along the ray the box shape begins; Infinity where it is missed.
  cairn.hit_wall = function (shape, start, way, placed) {
    const frame = stage_frame(shape, placed);
    return hit_box(
      start.clone().sub(frame.at).applyQuaternion(frame.back),
      way.clone().applyQuaternion(frame.back),
      shape.size,
    );
  };

  function stage_frame(shape, { position, rotation }) {
    const b = shape.body,
      turn = new THREE.Quaternion(...rotation.subarray(4 * b, 4 * b + 4));
    const at = shape.position.clone().applyQuaternion(turn);
    at.add(new THREE.Vector3(position[3 * b], position[3 * b + 1], position[3 * b + 2]));
    return { at, back: turn.multiply(shape.rotation).conjugate() };
  }

  // The body hit first, or -1; planes count only where nothing else is hit.
  cairn.pick_body = function (stage, position, rotation, x, y) {
    const { camera, viewport } = stage;
    const ray = new THREE.Raycaster();
    ray.setFromCamera(
      new THREE.Vector2((2 * x) / viewport.x - 1, 1 - (2 * y) / viewport.y),
      camera,
    );
    const start = ray.ray.origin,
      way = ray.ray.direction;
    let best = -1,
      nearest = Infinity;
    const at = new THREE.Vector3(),
      turn = new THREE.Quaternion(),
      back = new THREE.Quaternion();
    const origin = new THREE.Vector3(),
      direction = new THREE.Vector3(),
      part = new THREE.Vector3();
    for (const shape of stage.shapes) {
      if (!shape.size || stage.glass.includes(shape.body)) continue;
      const b = shape.body;
      at.set(position[3 * b], position[3 * b + 1], position[3 * b + 2]);
      turn.set(rotation[4 * b], rotation[4 * b + 1], rotation[4 * b + 2], rotation[4 * b + 3]);
      if (shape.placed) {
        at.add(part.copy(shape.position).applyQuaternion(turn));
        turn.multiply(shape.rotation);
      }
      origin.copy(start).sub(at);
      // Past the ball about the shape, the exact question need not be asked.
      const along = -origin.dot(way);
      if (origin.lengthSq() - along * Math.abs(along) > shape.reach * shape.reach * 1.0001)
        continue;
      back.copy(turn).conjugate();
      origin.applyQuaternion(back);
      direction.copy(way).applyQuaternion(back);
      const t =
        shape.kind === "sphere"
          ? hit_sphere(origin, direction, shape.size[0])
          : shape.kind === "barrel"
            ? hit_barrel(origin, direction, shape.size)
            : hit_box(origin, direction, shape.size);
      if (t < nearest) {
        nearest = t;
        best = b;
      }
    }
    if (best >= 0) return { body: best, distance: nearest };
    for (const ground of stage.grounds) {
      const facing = way.dot(ground.normal);
      if (facing >= 0) continue;
      const t = part.copy(ground.middle).sub(start).dot(ground.normal) / facing;
      if (t > 0 && t < nearest && t < 20 * stage.radius) {
        nearest = t;
        best = ground.body;
      }
    }
    return { body: best, distance: nearest };
  };
})((globalThis.cairn = globalThis.cairn || {}));
