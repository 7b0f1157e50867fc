// What is drawn over the stones on demand: contact points, normals, velocities, the trail of a
// body.
"use strict";
(function (cairn) {
  const QUAD = new Float32Array([-1, 0, 0, 1, 0, 0, 1, 1, 0, -1, 1, 0]);

  // A growing set of segments drawn in one call.
  class Segments {
    constructor(scene, style, order) {
      this.material = cairn.segment_material(style);
      this.room = 0;
      this.mesh = new THREE.Mesh(new THREE.InstancedBufferGeometry(), this.material);
      this.mesh.frustumCulled = false;
      this.mesh.renderOrder = order;
      this.mesh.visible = false;
      scene.add(this.mesh);
    }

    reserve(count) {
      if (count <= this.room) return;
      this.room = Math.max(64, Math.ceil(count * 1.5));
      const geometry = new THREE.InstancedBufferGeometry();
      geometry.setAttribute("position", new THREE.BufferAttribute(QUAD, 3));
      geometry.setIndex([0, 1, 2, 0, 2, 3]);
      for (const name of ["start", "finish"]) {
        geometry.setAttribute(
          name,
          new THREE.InstancedBufferAttribute(new Float32Array(3 * this.room), 3).setUsage(
            THREE.DynamicDrawUsage,
          ),
        );
      }
      this.mesh.geometry.dispose();
      this.mesh.geometry = geometry;
    }

    // `fill(start, finish)` writes both ends of `count` segments.
    set(count, fill) {
      this.mesh.visible = count > 0;
      if (!count) return;
      this.reserve(count);
      const { start, finish } = this.mesh.geometry.attributes;
      const used = fill(start.array, finish.array);
      this.mesh.geometry.maxInstancedCount = used;
      this.mesh.visible = used > 0;
      start.needsUpdate = finish.needsUpdate = true;
    }
  }

  class Overlays {
    constructor(stage) {
      this.stage = stage;
      this.normals = new Segments(stage.scene, { width: 2.2, head: 1, opacity: 0.95 }, 12);
      this.velocities = new Segments(stage.scene, { width: 2.6, head: 1, opacity: 0.9 }, 11);
      this.trail = new Segments(
        stage.scene,
        { width: 1.6, head: 0, opacity: 0.5, depth: true },
        10,
      );
      this.dots = new THREE.Points(
        new THREE.BufferGeometry(),
        cairn.dot_material({ body_size: stage.typical }),
      );
      this.dots.frustumCulled = false;
      this.dots.renderOrder = 13;
      stage.scene.add(this.dots);
      this.find_scale();
    }

    // An impulse that most contacts stay below: its arrow is about a body long.
    find_scale() {
      const { recording } = this.stage,
        all = [];
      const frames = recording.contact_frames,
        every = Math.max(1, Math.ceil(frames.length / 40));
      for (let i = 0; i < frames.length; i += every) {
        const { impulse } = recording.contacts(frames[i]);
        const thin = Math.max(1, Math.ceil(impulse.length / 2000));
        for (let k = 0; k < impulse.length; k += thin) if (impulse[k] > 0) all.push(impulse[k]);
      }
      all.sort((a, b) => a - b);
      this.impulse_scale = all.length ? all[Math.floor(0.9 * (all.length - 1))] : 1;
    }

    set_theme(theme) {
      this.normals.material.uniforms.colour.value.set(theme.normal);
      this.velocities.material.uniforms.colour.value.set(theme.velocity);
      this.trail.material.uniforms.colour.value.set(theme.trail);
      this.dots.material.uniforms.colour.value.set(theme.normal);
      this.dots.material.uniforms.rim.value.set("#ffffff");
    }

    resize(viewport, ratio) {
      for (const segments of [this.normals, this.velocities, this.trail]) {
        segments.material.uniforms.viewport.value.copy(viewport);
      }
      this.dots.material.uniforms.ratio.value = ratio;
      this.dots.material.uniforms.viewport_height.value = viewport.y * ratio;
    }

    // Square roots: impulses span decades, and a large one should not cross the whole picture.
    strength(impulse) {
      return Math.min(Math.sqrt(impulse / this.impulse_scale), 2.5);
    }

    show_contacts(contacts, with_points, with_normals) {
      const count = contacts ? contacts.a.length : 0;
      this.dots.visible = with_points && count > 0;
      if (this.dots.visible) {
        const weight = Float32Array.from(contacts.impulse, (j) => Math.min(this.strength(j), 1.2));
        this.dots.geometry.dispose();
        this.dots.geometry = new THREE.BufferGeometry();
        this.dots.geometry.setAttribute("position", new THREE.BufferAttribute(contacts.point, 3));
        this.dots.geometry.setAttribute("weight", new THREE.BufferAttribute(weight, 1));
      }
      this.normals.material.uniforms.width.value = count > 400 ? 1.4 : 2.2;
      const length = 1.1 * this.stage.typical;
      this.normals.set(with_normals ? count : 0, (start, finish) => {
        let used = 0;
        for (let i = 0; i < count; ++i) {
          if (!(contacts.impulse[i] > 0)) continue;
          const l = length * (0.12 + this.strength(contacts.impulse[i]));
          for (let k = 0; k < 3; ++k) {
            start[3 * used + k] = contacts.point[3 * i + k];
            finish[3 * used + k] = contacts.point[3 * i + k] + l * contacts.normal[3 * i + k];
          }
          ++used;
        }
        return used;
      });
    }

    // An arrow is the way in a quarter of a second.
    show_velocities(centres, velocities) {
      const count = velocities ? velocities.length / 3 : 0,
        still = 0.02 * this.stage.typical;
      this.velocities.set(count, (start, finish) => {
        let used = 0;
        for (let i = 0; i < count; ++i) {
          const way = [0, 1, 2].map((k) => 0.25 * velocities[3 * i + k]);
          if (Math.hypot(...way) < still) continue;
          for (let k = 0; k < 3; ++k) {
            start[3 * used + k] = centres[3 * i + k];
            finish[3 * used + k] = centres[3 * i + k] + way[k];
          }
          ++used;
        }
        return used;
      });
    }

    // The way of a point through all frames, three numbers each; null for none.
    show_trail(path) {
      const count = path ? path.length / 3 - 1 : 0;
      this.trail.set(Math.max(count, 0), (start, finish) => {
        start.set(path.subarray(0, 3 * count));
        finish.set(path.subarray(3, 3 * count + 3));
        return count;
      });
    }
  }

  cairn.Overlays = Overlays;
})((globalThis.cairn = globalThis.cairn || {}));
