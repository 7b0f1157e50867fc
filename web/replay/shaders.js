// What three.js r111 lacks for this page: shadows that soften with distance, box edges, turning
// marks on balls, an endless ground with a fine grid, and lines and arrows of a given width in
// pixels.
//
// Shadows: percentage closer soft shadows (Fernando 2005). Blockers are searched over a Vogel disc,
// the filter's width follows from their distance; `shadowRadius` carries the light's apparent size,
// in shadow-map widths per unit of depth. Discs are turned per pixel (interleaved gradient noise,
// Jimenez 2014), which trades bands for a fine grain.
"use strict";
(function (cairn) {
  const SOFT_SHADOW = `
#ifdef USE_SHADOWMAP
#if NUM_DIR_LIGHT_SHADOWS > 0
uniform sampler2D directionalShadowMap[NUM_DIR_LIGHT_SHADOWS];
varying vec4 vDirectionalShadowCoord[NUM_DIR_LIGHT_SHADOWS];
#endif
vec2 vogel_point(float i, float count, float turn) {
  float angle = i * 2.39996323 + turn;
  return sqrt((i + 0.5) / count) * vec2(cos(angle), sin(angle));
}
float getShadow(sampler2D map, vec2 size, float bias, float light_size, vec4 coord) {
  vec3 at = coord.xyz / coord.w;
  at.z += bias;
  if (any(lessThan(at.xy, vec2(0.0))) || any(greaterThan(at, vec3(1.0)))) return 1.0;
  float turn = 6.2831853 * fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
  float texel = 1.0 / size.x;
  float search = max(light_size * 0.25, 3.0 * texel);
  float blocker_sum = 0.0, blockers = 0.0;
  for (int i = 0; i < 10; ++i) {
    float depth = unpackRGBAToDepth(texture2D(map, at.xy + search * vogel_point(float(i), 10.0, turn)));
    if (depth < at.z) { blocker_sum += depth; blockers += 1.0; }
  }
  if (blockers < 0.5) return 1.0;
  float gap = at.z - blocker_sum / blockers;
  float width = clamp(light_size * gap, 1.25 * texel, search);
  float lit = 0.0;
  for (int i = 0; i < 20; ++i) {
    float depth = unpackRGBAToDepth(texture2D(map, at.xy + width * vogel_point(float(i), 20.0, turn)));
    lit += step(at.z, depth);
  }
  lit /= 20.0;
  vec2 border = min(at.xy, 1.0 - at.xy);
  return mix(1.0, lit, smoothstep(0.0, 0.04, min(border.x, border.y)));
}
#endif`;

  cairn.install_soft_shadows = () => {
    THREE.ShaderChunk.shadowmap_pars_fragment = SOFT_SHADOW;
  };

  function patch(shader, where, replacements) {
    for (const [anchor, code] of replacements) {
      if (!shader[where].includes(anchor)) throw new Error("three.js lacks the chunk " + anchor);
      shader[where] = shader[where].replace(anchor, code);
    }
  }

  const STONE_VERTEX_HEAD = `
attribute vec4 tint;
varying vec3 v_local;
varying vec3 v_half;
varying vec4 v_tint;
varying vec3 v_axis_x;
varying vec3 v_axis_y;
varying vec3 v_axis_z;
varying vec3 v_face;
void main() {
  v_half = vec3(length(instanceMatrix[0].xyz), length(instanceMatrix[1].xyz), length(instanceMatrix[2].xyz));
  v_local = position * v_half;
  v_tint = tint;
  v_face = normal;
  mat3 to_view = mat3(viewMatrix);
  v_axis_x = to_view * instanceMatrix[0].xyz / v_half.x;
  v_axis_y = to_view * instanceMatrix[1].xyz / v_half.y;
  v_axis_z = to_view * instanceMatrix[2].xyz / v_half.z;`;

  const STONE_FRAGMENT_HEAD = `
varying vec3 v_local;
varying vec3 v_half;
varying vec4 v_tint;
varying vec3 v_axis_x;
varying vec3 v_axis_y;
varying vec3 v_axis_z;
varying vec3 v_face;
vec3 stone_normal;
float edge_light;
void main() {`;

  // A box: the normal leans outward near the edges, as if they were rounded, and a hairline follows
  // them.
  const BOX_SURFACE = `
  vec3 flat_axes = 1.0 - step(0.5, abs(v_face));
  vec3 to_edge = (v_half - abs(v_local)) * flat_axes + 1e9 * (1.0 - flat_axes);
  vec3 pixel = max(fwidth(v_local), vec3(1e-9));
  float smallest = min(v_half.x, min(v_half.y, v_half.z));
  float bevel = 0.14 * smallest;
  vec3 lean = clamp(1.0 - to_edge / bevel, 0.0, 1.0);
  float near_view = smoothstep(3.0, 14.0, smallest / max(pixel.x, max(pixel.y, pixel.z)));
  vec3 leaning = normalize(v_face + 0.85 * near_view * lean * lean * sign(v_local));
  stone_normal = normalize(leaning.x * v_axis_x + leaning.y * v_axis_y + leaning.z * v_axis_z);
  vec3 hair = clamp(1.6 - to_edge / pixel, 0.0, 1.0);
  float hairline = max(hair.x, max(hair.y, hair.z));
  diffuseColor.rgb *= 1.0 - 0.28 * hairline * (0.35 + 0.65 * near_view);
  edge_light = 0.05 * near_view * max(lean.x, max(lean.y, lean.z));`;

  // A ball: octants in two shades and three great circles, so that every turn shows.
  const BALL_SURFACE = `
  vec3 direction = normalize(v_local / v_half);
  stone_normal = normalize(direction.x * v_axis_x + direction.y * v_axis_y + direction.z * v_axis_z);
  vec3 soft = max(fwidth(direction), vec3(1e-6));
  vec3 side = clamp(direction / soft, -1.0, 1.0);
  float octant = 0.5 + 0.5 * side.x * side.y * side.z;
  diffuseColor.rgb = mix(diffuseColor.rgb * 0.70, min(diffuseColor.rgb * 1.14, vec3(1.0)), octant);
  vec3 circle = clamp(1.5 - abs(direction) / max(soft, vec3(0.012)), 0.0, 1.0);
  diffuseColor.rgb *= 1.0 - 0.16 * max(circle.x, max(circle.y, circle.z));
  edge_light = 0.0;`;

  // A capsule's side: the octants and circles of the balls at its ends, drawn on between them.
  const BARREL_SURFACE = `
  vec3 direction = normalize(vec3(v_local.x / v_half.x, 0.0, v_local.z / v_half.z));
  stone_normal = normalize(direction.x * v_axis_x + direction.z * v_axis_z);
  vec3 marked = vec3(direction.x, v_local.y / v_half.x, direction.z);
  vec3 soft = max(fwidth(marked), vec3(1e-6));
  vec3 side = clamp(marked / soft, -1.0, 1.0);
  float octant = 0.5 + 0.5 * side.x * side.y * side.z;
  diffuseColor.rgb = mix(diffuseColor.rgb * 0.70, min(diffuseColor.rgb * 1.14, vec3(1.0)), octant);
  vec3 circle = clamp(1.5 - abs(marked) / max(soft, vec3(0.012)), 0.0, 1.0);
  diffuseColor.rgb *= 1.0 - 0.16 * max(circle.x, max(circle.y, circle.z));
  edge_light = 0.0;`;

  // tint.w: 0 a dynamic body, 1 static, 2 kinematic (hatched); plus 4 where the pointer rests on
  // it.
  const MARKS = `
  float hovered = step(3.5, v_tint.w);
  float kind = v_tint.w - 4.0 * hovered;
  if (kind > 1.5) {
    float across = dot(v_local, vec3(1.0)) / (0.5 * min(v_half.x, min(v_half.y, v_half.z)));
    float wave = abs(fract(across) - 0.5) * 4.0 - 1.0;
    diffuseColor.rgb *= 0.86 + 0.14 * clamp(wave / max(fwidth(across) * 4.0, 1e-6), -1.0, 1.0);
  }
  diffuseColor.rgb = mix(diffuseColor.rgb, vec3(1.0), 0.16 * hovered);`;

  cairn.stone_material = function (kind) {
    const material = new THREE.MeshStandardMaterial({ roughness: 0.62, metalness: 0 });
    const surface = { sphere: BALL_SURFACE, barrel: BARREL_SURFACE, box: BOX_SURFACE }[kind];
    const compile = (shader) => {
      patch(shader, "vertexShader", [["void main() {", STONE_VERTEX_HEAD]]);
      patch(shader, "fragmentShader", [
        ["void main() {", STONE_FRAGMENT_HEAD],
        ["#include <color_fragment>", "diffuseColor.rgb = v_tint.rgb;" + MARKS + surface],
        [
          "#include <normal_fragment_begin>",
          "vec3 normal = stone_normal; vec3 geometryNormal = normal;",
        ],
        [
          "#include <emissivemap_fragment>",
          "totalEmissiveRadiance += edge_light * diffuseColor.rgb;",
        ],
      ]);
    };
    // r111 tells programs apart by the text of this function: each kind needs its own.
    material.onBeforeCompile = {
      sphere: (shader) => compile(shader, "sphere"),
      barrel: (shader) => compile(shader, "barrel"),
      box: (shader) => compile(shader, "box"),
    }[kind];
    material.extensions = { derivatives: true };
    return material;
  };

  // A plane's surface: a grid of 1 and 10 spacings that fades out, like the ground itself, far
  // away.
  cairn.ground_material = function () {
    const uniforms = {
      line: { value: new THREE.Color() },
      spacing: { value: 1 },
      offset: { value: new THREE.Vector2() },
      fade: { value: new THREE.Vector2(1, 2) },
      grid_strength: { value: 1 },
    };
    const material = new THREE.MeshStandardMaterial({
      roughness: 0.95,
      metalness: 0,
      transparent: true,
    });
    material.onBeforeCompile = (shader) => {
      Object.assign(shader.uniforms, uniforms);
      patch(shader, "vertexShader", [
        ["void main() {", "varying vec2 v_ground;\nvoid main() {\n v_ground = position.xy;"],
      ]);
      patch(shader, "fragmentShader", [
        [
          "void main() {",
          `
varying vec2 v_ground;
uniform vec3 line;
uniform float spacing;
uniform vec2 offset;
uniform vec2 fade;
uniform float grid_strength;
float grid(vec2 at, float width) {
  vec2 pixel = max(fwidth(at), vec2(1e-9));
  vec2 to_line = abs(fract(at - 0.5) - 0.5) / pixel;
  vec2 drawn = clamp(0.5 * width + 0.5 - to_line, 0.0, 1.0) * clamp(1.6 - 4.0 * pixel, 0.0, 1.0);
  return max(drawn.x, drawn.y);
}
void main() {`,
        ],
        [
          "#include <color_fragment>",
          `
  vec2 at = (v_ground + offset) / spacing;
  float drawn = max(0.32 * grid(at, 1.0), 0.62 * grid(at / 10.0, 1.4));
  diffuseColor.rgb = mix(diffuseColor.rgb, line, drawn * grid_strength);
  diffuseColor.a *= 1.0 - smoothstep(fade.x, fade.y, length(v_ground));`,
        ],
      ]);
    };
    material.extensions = { derivatives: true };
    return { material, uniforms };
  };

  // Instanced segments, drawn as quads `width` pixels wide, with a head where `head` is 1.
  const SEGMENT_VERTEX = `
attribute vec3 start;
attribute vec3 finish;
uniform vec2 viewport;
uniform float width;
uniform float head;
varying vec2 v_at;
varying float v_length;
void main() {
  vec4 a = projectionMatrix * viewMatrix * vec4(start, 1.0);
  vec4 b = projectionMatrix * viewMatrix * vec4(finish, 1.0);
  float near = 1e-4;
  if (a.w < near && b.w < near) { gl_Position = vec4(2.0, 2.0, 2.0, 1.0); return; }
  if (a.w < near) a = mix(a, b, (near - a.w) / (b.w - a.w));
  if (b.w < near) b = mix(b, a, (near - b.w) / (a.w - b.w));
  vec2 pa = a.xy / a.w * viewport * 0.5, pb = b.xy / b.w * viewport * 0.5;
  vec2 along = pb - pa;
  v_length = length(along);
  if (v_length < 0.5) { gl_Position = vec4(2.0, 2.0, 2.0, 1.0); return; }
  along /= v_length;
  float reach = (head > 0.5 ? 3.2 : 1.0) * width;
  vec4 base = position.y > 0.5 ? b : a;
  vec2 shift = along * (position.y > 0.5 ? 1.0 : -1.0) + vec2(-along.y, along.x) * position.x * reach;
  v_at = vec2(position.x * reach, position.y > 0.5 ? v_length + 1.0 : -1.0);
  gl_Position = vec4(base.xy + shift / (viewport * 0.5) * base.w, base.zw);
}`;
  const SEGMENT_FRAGMENT = `
uniform vec3 colour;
uniform float opacity;
uniform float width;
uniform float head;
varying vec2 v_at;
varying float v_length;
void main() {
  float head_length = min(head * width * 4.2, v_length);
  float left = v_length - v_at.y;
  float half_width = left < head_length ? left * 0.55 : 0.5 * width;
  float cover = clamp(half_width - abs(v_at.x) + 0.5, 0.0, 1.0) * clamp(v_at.y + 0.5, 0.0, 1.0)
    * clamp(left + 0.5, 0.0, 1.0);
  if (cover <= 0.0) discard;
  gl_FragColor = vec4(colour, opacity * cover);
}`;

  cairn.segment_material = ({ width, head, opacity, depth }) =>
    new THREE.ShaderMaterial({
      vertexShader: SEGMENT_VERTEX,
      fragmentShader: SEGMENT_FRAGMENT,
      transparent: true,
      depthTest: !!depth,
      depthWrite: false,
      side: THREE.DoubleSide,
      uniforms: {
        colour: { value: new THREE.Color() },
        width: { value: width },
        head: { value: head },
        opacity: { value: opacity },
        viewport: { value: new THREE.Vector2(1, 1) },
      },
    });

  cairn.dot_material = ({ body_size }) =>
    new THREE.ShaderMaterial({
      transparent: true,
      depthTest: false,
      depthWrite: false,
      uniforms: {
        colour: { value: new THREE.Color() },
        rim: { value: new THREE.Color() },
        body_size: { value: body_size },
        ratio: { value: 1 },
        viewport_height: { value: 1 },
      },
      vertexShader: `
attribute float weight;
uniform float body_size;
uniform float ratio;
uniform float viewport_height;
varying float v_size;
void main() {
  gl_Position = projectionMatrix * viewMatrix * vec4(position, 1.0);
  // As large as a sixth of a body looks, within what the eye can tell apart and what hides nothing.
  float seen = body_size * projectionMatrix[1][1] * 0.5 * viewport_height / max(gl_Position.w, 1e-6);
  v_size = clamp(seen / 6.0, 2.5 * ratio, 8.0 * ratio) * (0.6 + 0.7 * weight);
  gl_PointSize = v_size + 2.0;
}`,
      fragmentShader: `
uniform vec3 colour;
uniform vec3 rim;
varying float v_size;
void main() {
  float away = length(gl_PointCoord - 0.5) * (v_size + 2.0);
  float cover = clamp(0.5 * v_size - away + 0.5, 0.0, 1.0);
  if (cover <= 0.0) discard;
  float rimmed = clamp(away - 0.5 * v_size + 1.6, 0.0, 1.0) * smoothstep(4.0, 7.0, v_size);
  gl_FragColor = vec4(mix(colour, rim, rimmed), cover);
}`,
    });

  // A rim of `width` pixels about a body: its back faces, pushed out from the middle in the
  // picture.
  cairn.outline_material = () =>
    new THREE.ShaderMaterial({
      side: THREE.BackSide,
      transparent: true,
      uniforms: {
        colour: { value: new THREE.Color() },
        viewport: { value: new THREE.Vector2(1, 1) },
        width: { value: 2.5 },
      },
      vertexShader: `
uniform vec2 viewport;
uniform float width;
void main() {
  vec4 at = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  vec3 outward = normalize(mat3(modelViewMatrix) * normalize(position));
  vec2 push = normalize((projectionMatrix * vec4(outward, 0.0)).xy * viewport + 1e-9);
  at.xy += push * width * 2.0 / viewport * at.w;
  gl_Position = at;
}`,
      fragmentShader: "uniform vec3 colour; void main() { gl_FragColor = vec4(colour, 0.95); }",
    });
})((globalThis.cairn = globalThis.cairn || {}));
