// The 3D scene: instanced stones, grounds, light and shadow. Everything is placed about the
// recording's origin. One instanced mesh a shape kind: five thousand bodies are two draw calls.
//
// cairn.Stage: show(position, rotation) places the bodies, render() draws. The options are the
// page's (main.js reads them from the address).
"use strict";
(function (cairn) {
  const GEOMETRY = {
    box: () => new THREE.BoxBufferGeometry(2, 2, 2),
    sphere: (count) =>
      count > 1500
        ? new THREE.SphereBufferGeometry(1, 18, 12)
        : count > 200
          ? new THREE.SphereBufferGeometry(1, 32, 20)
          : new THREE.SphereBufferGeometry(1, 56, 36),
    barrel: (count) =>
      new THREE.CylinderBufferGeometry(1, 1, 2, count > 1500 ? 18 : count > 200 ? 32 : 56, 1, true),
  };
  const vector = (list) => new THREE.Vector3(list[0], list[1], list[2]);

  // What a shape is drawn as: boxes and balls as they are, a capsule as a barrel between two balls
  // `up` its axis. Sizes are half extents.
  function list_parts(geometry) {
    const r = geometry.radius;
    if (geometry.kind === "box") return [{ kind: "box", size: geometry.half_extents, up: 0 }];
    if (geometry.kind === "sphere") return [{ kind: "sphere", size: [r, r, r], up: 0 }];
    if (geometry.kind !== "capsule") return [{ kind: geometry.kind, size: null, up: 0 }];
    const half = geometry.height / 2;
    const ends = [half, -half].map((up) => ({ kind: "sphere", size: [r, r, r], up }));
    return half > 0 ? [{ kind: "barrel", size: [r, half, r], up: 0 }, ...ends] : ends.slice(1);
  }

  // Every part of every shape of every body: kind, size, body, place in the body.
  function list_shapes(header) {
    const shapes = [];
    header.bodies.shapes.forEach((list, body) => {
      for (const [index, ...pose] of list) {
        const geometry = header.geometries[index];
        const position = pose.length ? vector(pose) : new THREE.Vector3();
        const rotation = pose.length
          ? new THREE.Quaternion(pose[3], pose[4], pose[5], pose[6])
          : new THREE.Quaternion();
        for (const { kind, size, up } of list_parts(geometry)) {
          const shift = new THREE.Vector3(0, up, 0).applyQuaternion(rotation);
          shapes.push({
            body,
            geometry,
            kind,
            size,
            placed: pose.length > 0 || up !== 0,
            position: position.clone().add(shift),
            rotation,
            reach: size ? Math.hypot(...(kind === "sphere" ? [size[0]] : size)) : 0,
          });
        }
      }
    });
    return shapes;
  }

  function percentile(sorted, share) {
    return sorted[
      Math.min(sorted.length - 1, Math.max(0, Math.round(share * (sorted.length - 1))))
    ];
  }

  class Stage {
    constructor(canvas, recording, options) {
      this.recording = recording;
      this.header = recording.header;
      this.options = options;
      this.shapes = list_shapes(this.header);
      this.reach = new Float32Array(recording.body_count);
      for (const s of this.shapes) {
        this.reach[s.body] = Math.max(this.reach[s.body], s.reach + s.position.length());
      }
      const gravity = vector(this.header.gravity);
      this.up =
        gravity.lengthSq() > 0 ? gravity.clone().normalize().negate() : new THREE.Vector3(0, 1, 0);
      this.measure();
      this.make_renderer(canvas);
      this.make_lights();
      this.make_stones();
      this.make_grounds();
      this.set_theme(options.theme);
    }

    // Where things happen, and how large they are: `bounds` about nearly all of the motion (a ball
    // that flies off must not shrink the rest), `typical` the middle size of a moving body.
    measure() {
      const { recording, header } = this;
      const moving = [...header.bodies.kinds].flatMap((k, i) =>
        k !== "s" && this.reach[i] > 0 ? [i] : [],
      );
      const still = [...header.bodies.kinds].flatMap((k, i) =>
        k === "s" && this.reach[i] > 0 ? [i] : [],
      );
      const watched = moving.length ? moving : still;
      const frames = [];
      const every = Math.max(1, Math.ceil(recording.frame_count / 24));
      for (let f = 0; f < recording.frame_count; f += every) frames.push(f);
      const thin = Math.max(1, Math.ceil((watched.length * frames.length) / 200000));
      const axes = [[], [], []],
        seen = [];
      for (const f of frames) {
        const { position } = recording.pose(f);
        for (let k = 0; k < watched.length; k += thin) {
          for (let i = 0; i < 3; ++i) axes[i].push(position[3 * watched[k] + i]);
          seen.push([
            position.subarray(3 * watched[k], 3 * watched[k] + 3),
            this.reach[watched[k]],
          ]);
        }
      }
      const sizes = watched.map((i) => this.reach[i]).sort((a, b) => a - b);
      this.typical = sizes.length ? percentile(sizes, 0.5) : 1;
      this.bounds = new THREE.Box3();
      axes.forEach((values, i) => {
        if (!values.length) values.push(0);
        values.sort((a, b) => a - b);
        const axis = "xyz"[i];
        this.bounds.min[axis] = percentile(values, 0.004) - this.typical;
        this.bounds.max[axis] = percentile(values, 0.996) + this.typical;
      });
      // What the camera should have in view: of each of these points a ball.
      const every_seen = Math.ceil(seen.length / 4000);
      this.seen = seen
        .filter((_, i) => i % every_seen === 0)
        .map(([at, reach]) => ({ at: vector(at), reach }))
        .filter(({ at }) => this.bounds.containsPoint(at));
      // Still bodies near the motion belong to the picture; a huge floor slab does not set its
      // size.
      const first = recording.pose(0).position,
        span = this.bounds.getSize(new THREE.Vector3()).length();
      for (const i of still) {
        const at = vector(first.subarray(3 * i, 3 * i + 3));
        if (this.reach[i] < span && this.bounds.distanceToPoint(at) < 0.5 * span) {
          this.bounds.expandByPoint(at.clone().addScalar(0.6 * this.reach[i]));
          this.bounds.expandByPoint(at.addScalar(-0.6 * this.reach[i]));
        }
      }
      this.centre = this.bounds.getCenter(new THREE.Vector3());
      this.radius = Math.max(0.5 * this.bounds.getSize(new THREE.Vector3()).length(), 1e-6);
    }

    make_renderer(canvas) {
      const attributes = {
        alpha: true,
        antialias: this.options.antialias,
        preserveDrawingBuffer: true,
      };
      const context =
        canvas.getContext("webgl2", attributes) || canvas.getContext("webgl", attributes);
      if (!context) throw new Error("this browser gives the page no WebGL, which it needs to draw");
      const names = context.getExtension("WEBGL_debug_renderer_info");
      const drawn_by = names ? String(context.getParameter(names.UNMASKED_RENDERER_WEBGL)) : "";
      // Without a graphics processor soft shadows take seconds a frame.
      if (this.options.shadows === null)
        this.options.shadows = !/swiftshader|llvmpipe|software/i.test(drawn_by);
      cairn.install_soft_shadows();
      this.renderer = new THREE.WebGLRenderer({
        canvas,
        context,
        alpha: true,
        antialias: this.options.antialias,
      });
      this.renderer.gammaOutput = true;
      this.renderer.gammaFactor = 2.2;
      this.renderer.setClearColor(0, 0);
      this.renderer.shadowMap.enabled = this.options.shadows;
      this.renderer.shadowMap.autoUpdate = false;
      this.scene = new THREE.Scene();
      this.camera = new THREE.PerspectiveCamera(36, 1, 0.01 * this.radius, 400 * this.radius);
      this.camera.up.copy(this.up);
    }

    make_lights() {
      this.sky = new THREE.HemisphereLight(0xffffff, 0xffffff, 1);
      this.sky.position.copy(this.up);
      const { side, ahead } = this.horizon();
      // The sun stands over the viewer's left shoulder, as painters like it.
      const towards_sun = this.up
        .clone()
        .multiplyScalar(1.15)
        .addScaledVector(side, -0.8)
        .addScaledVector(ahead, -0.6);
      this.sun = this.make_light(towards_sun.normalize(), 0.09, 4096);
      // A second, broad light from straight above: its wide shadow darkens the places under and
      // between.
      const towards_top = this.up.clone().addScaledVector(side, 0.12).normalize();
      this.top = this.make_light(towards_top, 0.85, 1024);
      this.scene.add(this.sky, this.sun, this.sun.target, this.top, this.top.target);
    }

    make_light(direction, apparent_size, pixels) {
      const light = new THREE.DirectionalLight(0xffffff, 1);
      const radius = 1.06 * this.radius + this.typical,
        depth = 4 * radius;
      light.position.copy(this.centre).addScaledVector(direction, 0.5 * depth);
      light.target.position.copy(this.centre);
      light.castShadow = this.options.shadows;
      Object.assign(light.shadow.camera, {
        left: -radius,
        right: radius,
        top: radius,
        bottom: -radius,
        near: 0.01 * depth,
        far: depth,
      });
      const most = this.renderer.capabilities.maxTextureSize;
      light.shadow.mapSize.set(Math.min(pixels, most), Math.min(pixels, most));
      // In the shadow map's own units: widths of the map per unit of its depth.
      light.shadow.radius = Math.min((apparent_size * depth) / (2 * radius), 0.4);
      light.shadow.bias = -0.0006;
      return light;
    }

    // Two level directions: to the camera's right, and away from it.
    horizon() {
      const camera = this.header.camera;
      const ahead = vector(camera.target).sub(vector(camera.eye));
      ahead.addScaledVector(this.up, -ahead.dot(this.up));
      if (ahead.lengthSq() < 1e-12) ahead.set(this.up.y, this.up.z, this.up.x).cross(this.up);
      ahead.normalize();
      return { ahead, side: new THREE.Vector3().crossVectors(ahead, this.up) };
    }

    make_stones() {
      this.groups = [];
      for (const kind of Object.keys(GEOMETRY)) {
        const shapes = this.shapes.filter((s) => s.kind === kind);
        if (!shapes.length) continue;
        const geometry = GEOMETRY[kind](shapes.length);
        const tint = new THREE.InstancedBufferAttribute(new Float32Array(4 * shapes.length), 4);
        geometry.setAttribute("tint", tint);
        const mesh = new THREE.InstancedMesh(geometry, cairn.stone_material(kind), shapes.length);
        mesh.frustumCulled = false;
        mesh.castShadow = mesh.receiveShadow = true;
        mesh.instanceMatrix.setUsage(THREE.DynamicDrawUsage);
        this.scene.add(mesh);
        this.groups.push({ kind, shapes, mesh, tint });
      }
      this.glass = [];
      this.panes = new THREE.Group();
      this.pane_material = new THREE.MeshBasicMaterial({
        transparent: true,
        opacity: 0.1,
        depthWrite: false,
      });
      this.pane_edges = new THREE.EdgesGeometry(new THREE.BoxBufferGeometry(2, 2, 2));
      this.rim_material = new THREE.LineBasicMaterial({ transparent: true, opacity: 0.4 });
      this.scene.add(this.panes);
      this.outline = new THREE.Group();
      this.outline_material = cairn.outline_material();
      this.scene.add(this.outline);
    }

    make_grounds() {
      this.grounds = [];
      const { position, rotation } = this.recording.pose(0),
        origin = vector(this.header.lattice.origin);
      for (const shape of this.shapes.filter((s) => s.kind === "plane")) {
        const i = shape.body;
        const turn = new THREE.Quaternion(...rotation.subarray(4 * i, 4 * i + 4));
        const at = vector(position.subarray(3 * i, 3 * i + 3)).add(
          shape.position.clone().applyQuaternion(turn),
        );
        turn.multiply(shape.rotation);
        const normal = vector(shape.geometry.normal).normalize().applyQuaternion(turn);
        const offset = shape.geometry.offset + normal.dot(at);
        this.grounds.push(this.make_ground(i, normal, offset, origin));
      }
    }

    make_ground(body, normal, offset, origin) {
      const level = normal.dot(this.up);
      const is_floor = level > 0.5;
      const middle = this.centre.clone().addScaledVector(normal, offset - normal.dot(this.centre));
      // Upright planes are walls: no larger than what they hold in, or they would hide it.
      const inner = is_floor ? 1.8 * this.radius + 2 * this.typical : 0.7 * this.radius;
      const outer = is_floor ? 7 * this.radius + 6 * this.typical : 1.5 * this.radius;
      const { side, ahead } = this.horizon();
      const reference =
        Math.abs(normal.x) < 0.9 ? new THREE.Vector3(1, 0, 0) : new THREE.Vector3(0, 0, 1);
      const v = new THREE.Vector3().crossVectors(normal, reference).normalize();
      const u = new THREE.Vector3().crossVectors(v, normal);
      const { material, uniforms } = cairn.ground_material();
      const mesh = new THREE.Mesh(new THREE.CircleBufferGeometry(outer, 96), material);
      mesh.matrixAutoUpdate = false;
      mesh.matrix.makeBasis(u, v, normal).setPosition(middle);
      mesh.receiveShadow = true;
      mesh.renderOrder = -1;
      const spacing = Math.pow(10, Math.round(Math.log10(2 * this.typical)));
      const whole = 10 * spacing,
        world = middle.clone().add(origin);
      uniforms.spacing.value = spacing;
      uniforms.offset.value.set(world.dot(u) % whole, world.dot(v) % whole);
      uniforms.fade.value.set(inner, outer);
      this.scene.add(mesh);
      return { body, mesh, uniforms, is_floor, normal, middle, side, ahead };
    }

    set_theme(name) {
      const theme = (this.theme = cairn.THEMES[name]);
      this.sky.color = cairn.linear(theme.sky);
      this.sky.groundColor = cairn.linear(theme.earth);
      this.sky.intensity = theme.sky_strength;
      this.sun.color = cairn.linear(theme.sun);
      this.shade();
      for (const ground of this.grounds) {
        ground.mesh.material.color = cairn.linear(ground.is_floor ? theme.ground : theme.wall);
        ground.uniforms.line.value = cairn.linear(theme.line);
      }
      this.pane_material.color = cairn.linear(theme.kinematic);
      this.rim_material.color = cairn.linear(theme.kinematic);
      this.outline_material.uniforms.colour.value.set(theme.outline);
      const first = this.recording.pose(0).position;
      const heights = Array.from(this.reach, (_, i) =>
        vector(first.subarray(3 * i, 3 * i + 3)).dot(this.up),
      );
      this.own_colours = cairn.colour_bodies(this.recording, heights, this.reach, theme);
      this.paint(null);
    }

    // Where nothing casts a shadow the sun is weaker, or all would be glaring.
    shade() {
      const strength = this.sun.castShadow ? 1 : 0.9;
      this.sun.intensity = this.theme.sun_strength * strength;
      this.top.intensity = this.theme.top_strength * strength;
    }

    // Each body in its own colour, or, given a speed a body from 0 to 1, by that.
    paint(speeds) {
      const kinds = this.header.bodies.kinds;
      for (const { shapes, tint } of this.groups) {
        shapes.forEach(({ body }, i) => {
          const colour =
            speeds && kinds[body] !== "s"
              ? cairn.speed_colour(speeds[body])
              : this.own_colours[body];
          const mark =
            (kinds[body] === "s" ? 1 : kinds[body] === "k" ? 2 : 0) +
            (body === this.hovered ? 4 : 0);
          tint.array.set([colour.r, colour.g, colour.b, mark], 4 * i);
        });
        tint.needsUpdate = true;
      }
    }

    // Places every stone. Column-major: rotation times size, then position.
    show(position, rotation) {
      const at = new THREE.Vector3(),
        turn = new THREE.Quaternion(),
        size = new THREE.Vector3();
      const matrix = new THREE.Matrix4();
      this.placed = { position, rotation };
      for (const { shapes, mesh } of this.groups) {
        const target = mesh.instanceMatrix.array;
        shapes.forEach((shape, i) => {
          const b = shape.body;
          turn.set(rotation[4 * b], rotation[4 * b + 1], rotation[4 * b + 2], rotation[4 * b + 3]);
          at.set(position[3 * b], position[3 * b + 1], position[3 * b + 2]);
          if (shape.placed) {
            at.add(size.copy(shape.position).applyQuaternion(turn));
            turn.multiply(shape.rotation);
          }
          size.set(shape.size[0], shape.size[1], shape.size[2]);
          matrix.compose(at, turn, size).toArray(target, 16 * i);
        });
        mesh.instanceMatrix.needsUpdate = true;
      }
      this.hide_instances_of(this.glass);
      this.place_outline();
      this.renderer.shadowMap.needsUpdate = true;
    }

    // Walls between the eye and what moves become glass, or a pit could not be seen into. `bodies`:
    // which.
    // Their stones shrink to nothing, and see-through twins with drawn edges stand in their place.
    set_glass(bodies) {
      if (bodies.length === this.glass.length && bodies.every((body, i) => body === this.glass[i]))
        return false;
      this.glass = bodies;
      for (const old of [...this.panes.children]) this.panes.remove(old);
      const box = this.groups.find(({ kind }) => kind === "box");
      for (const shape of box ? box.shapes.filter((s) => bodies.includes(s.body)) : []) {
        const pane = new THREE.Mesh(box.mesh.geometry, this.pane_material);
        const rims = new THREE.LineSegments(this.pane_edges, this.rim_material);
        pane.matrixAutoUpdate = false;
        pane.matrix.copy(this.place_shape(shape, this.placed));
        pane.add(rims);
        this.panes.add(pane);
      }
      return true;
    }

    // A static box hides things if it stands before more than an eighth of some that move.
    find_walls(hits) {
      const { position } = this.placed,
        kinds = this.header.bodies.kinds,
        eye = this.camera.position;
      const walls = this.shapes.filter(
        (s) => s.kind === "box" && kinds[s.body] === "s" && s.reach > 2 * this.typical,
      );
      const moving = [...kinds].flatMap((kind, i) => (kind === "d" ? [i] : []));
      if (!walls.length || walls.length > 60 || !moving.length) return [];
      const every = Math.ceil(moving.length / 64),
        found = new Set();
      const watched = moving.filter((_, i) => i % every === 0);
      for (const wall of walls) {
        const hidden = watched.filter((body) => {
          const way = vector(position.subarray(3 * body, 3 * body + 3)).sub(eye),
            far = way.length();
          return hits(wall, eye, way.divideScalar(far), this.placed) < far - this.reach[body];
        });
        if (8 * hidden.length > watched.length) found.add(wall.body);
      }
      return [...found];
    }

    hide_instances_of(bodies) {
      if (!bodies.length) return;
      for (const { shapes, mesh } of this.groups) {
        shapes.forEach((shape, i) => {
          if (bodies.includes(shape.body)) mesh.instanceMatrix.array.fill(0, 16 * i, 16 * i + 12);
        });
      }
    }

    place_shape(shape, { position, rotation }) {
      const b = shape.body;
      const turn = new THREE.Quaternion(...rotation.subarray(4 * b, 4 * b + 4));
      const at = shape.position
        .clone()
        .applyQuaternion(turn)
        .add(vector(position.subarray(3 * b, 3 * b + 3)));
      return new THREE.Matrix4().compose(at, turn.multiply(shape.rotation), vector(shape.size));
    }

    outline_body(body) {
      this.outlined = body;
      for (const old of [...this.outline.children]) this.outline.remove(old);
      for (const { shapes, mesh } of this.groups) {
        shapes.forEach((shape, i) => {
          if (shape.body !== body) return;
          const rim = new THREE.Mesh(mesh.geometry, this.outline_material);
          rim.matrixAutoUpdate = false;
          rim.frustumCulled = false;
          rim.userData = { mesh, i };
          this.outline.add(rim);
        });
      }
      this.place_outline();
    }

    place_outline() {
      for (const rim of this.outline.children) {
        rim.matrix.fromArray(rim.userData.mesh.instanceMatrix.array, 16 * rim.userData.i);
      }
    }

    // For machines that cannot keep up: no shadows, one pixel a pixel.
    draw_plainly() {
      this.plain = true;
      this.sun.castShadow = this.top.castShadow = false;
      this.shade();
      for (const { mesh } of this.groups) mesh.material.needsUpdate = true;
      for (const { mesh } of this.grounds) mesh.material.needsUpdate = true;
    }

    // `clear`: pixels at the bottom and top that panels cover; the picture is centred in the rest.
    resize(width, height, ratio, clear) {
      if (this.plain) ratio = 1;
      this.renderer.setPixelRatio(ratio);
      this.renderer.setSize(width, height, false);
      const covered = Math.min(clear.bottom + clear.top, 0.75 * height);
      const aspect = width / (height - covered);
      // At 16:10 a lens of 36 degrees; in an upright window wider, so that as much fits across.
      const across = Math.tan((18 * Math.PI) / 180) * 1.6;
      const free =
        aspect > 1.25
          ? Math.tan((18 * Math.PI) / 180)
          : Math.min((across / aspect) * 0.86, Math.tan((38 * Math.PI) / 180));
      const share = height / (height - covered);
      this.camera.fov = (2 * Math.atan(free * share) * 180) / Math.PI;
      this.camera.aspect = width / height;
      this.camera.setViewOffset(width, height, 0, (clear.bottom - clear.top) / 2, width, height);
      this.viewport = new THREE.Vector2(width, height);
      this.covered = covered;
      this.outline_material.uniforms.viewport.value.copy(this.viewport);
    }

    render() {
      const away = this.camera.position.distanceTo(this.centre);
      this.camera.near = Math.max(0.02 * this.typical, 0.002 * away);
      this.camera.far = away + 14 * this.radius + 20 * this.typical;
      this.camera.updateProjectionMatrix();
      this.renderer.render(this.scene, this.camera);
    }
  }

  cairn.Stage = Stage;
})((globalThis.cairn = globalThis.cairn || {}));
