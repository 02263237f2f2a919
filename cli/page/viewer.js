// Shows a run's glTF model, brought by the script caches/scene.glb.js, at the moment that the player shows.
(() => {
  "use strict";
  const section = document.getElementById("viewer");
  if (!section) return;
  const canvas = document.getElementById("scene");
  const state = document.getElementById("scene-state");
  const clamp = (value, low, high) => Math.min(Math.max(value, low), high);
  let time = 0; // [s] that the player shows
  let scene = null;

  function give_up(reason) {
    canvas.hidden = true;
    state.textContent = reason;
  }

  // The file: a header of 12 bytes, then the JSON chunk and the binary chunk, each after its length and name.
  function parse(base64) {
    const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
    const header = new DataView(bytes.buffer);
    const length = header.getUint32(12, true);
    const json = JSON.parse(new TextDecoder().decode(bytes.subarray(20, 20 + length)));
    const binary = bytes.subarray(28 + length);
    const view = (index) => {
      const { byteOffset, byteLength } = json.bufferViews[index];
      return binary.subarray(byteOffset, byteOffset + byteLength);
    };
    return { json, view, accessor: (index) => json.accessors[index], data: (index) => view(json.accessors[index].bufferView) };
  }

  const vertex_shader = `#version 300 es
    // A vertex lies between two keys, each a displacement from the first.
    layout(location = 0) in vec3 base_position;
    layout(location = 1) in vec3 base_normal;
    layout(location = 2) in vec2 base_uv;
    layout(location = 3) in vec3 position_before;
    layout(location = 4) in vec3 normal_before;
    layout(location = 5) in vec3 position_after;
    layout(location = 6) in vec3 normal_after;
    layout(location = 7) in vec3 own_colour;
    uniform mat4 to_clip;
    uniform float share;
    out vec3 place, normal;
    out vec2 uv;
    out vec3 tint;
    void main() {
      tint = own_colour;
      place = base_position + mix(position_before, position_after, share);
      normal = base_normal + mix(normal_before, normal_after, share);
      uv = base_uv;
      gl_Position = to_clip * vec4(place, 1.0);
    }`;
  const fragment_shader = `#version 300 es
    precision highp float;
    in vec3 place, normal;
    in vec2 uv;
    in vec3 tint;
    uniform vec3 eye, centre, key, colour;
    uniform float radius, opacity, hole_below;
    uniform bool textured;
    uniform sampler2D picture;
    out vec4 pixel;
    void main() {
      vec3 n = normalize(normal) * (gl_FrontFacing ? 1.0 : -1.0), v = normalize(eye - place);
      vec4 texel = textured ? texture(picture, uv) : vec4(1.0);
      if (texel.a * opacity < hole_below) discard;
      vec3 base = texel.rgb * colour * tint;
      vec3 sky = mix(vec3(0.30, 0.28, 0.26), vec3(0.62, 0.66, 0.72), 0.5 + 0.5 * n.y);
      float gloss = 0.06 * pow(max(dot(n, normalize(key + v)), 0.0), 24.0);
      vec3 light = base * (sky + 0.85 * max(dot(n, key), 0.0)) + gloss;
      vec3 srgb = mix(12.92 * light, 1.055 * pow(light, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, light));
      // A floor has no edge: it fades.
      float solid = 1.0 - smoothstep(2.5, 5.0, distance(place, centre) / radius);
      pixel = vec4(min(srgb, 1.0) * solid, solid);
    }`;

  function program_of(gl) {
    const program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, vertex_shader], [gl.FRAGMENT_SHADER, fragment_shader]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
    return program;
  }

  function buffer_of(gl, target, data) {
    const buffer = gl.createBuffer();
    gl.bindBuffer(target, buffer);
    gl.bufferData(target, data, gl.STATIC_DRAW);
    return buffer;
  }

  function picture_of(gl, file, index, drawn) {
    const image = file.json.images[file.json.textures[index].source];
    const picture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, picture);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.SRGB8_ALPHA8, 1, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array([128, 128, 128, 255]));
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR);
    const bitmap = new Image();
    bitmap.onload = () => {
      URL.revokeObjectURL(bitmap.src);
      gl.bindTexture(gl.TEXTURE_2D, picture);
      gl.texImage2D(gl.TEXTURE_2D, 0, gl.SRGB8_ALPHA8, gl.RGBA, gl.UNSIGNED_BYTE, bitmap);
      gl.generateMipmap(gl.TEXTURE_2D);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_LINEAR);
      drawn();
    };
    bitmap.src = URL.createObjectURL(new Blob([file.view(image.bufferView)], { type: image.mimeType }));
    return picture;
  }

  // The meshes, on the graphics processor.
  function load(gl, file, drawn) {
    const numbers = (index) => buffer_of(gl, gl.ARRAY_BUFFER, file.data(index));
    const pictures = (file.json.textures || []).map((_, index) => picture_of(gl, file, index, drawn));
    return file.json.meshes.flatMap((mesh) => {
      // All primitives of a mesh are over the same vertices.
      const first = mesh.primitives[0];
      const base = ["POSITION", "NORMAL", "TEXCOORD_0"].map((name) => numbers(first.attributes[name]));
      const targets = (first.targets || []).map((target) => [numbers(target.POSITION), numbers(target.NORMAL)]);
      const tint = "COLOR_0" in first.attributes ? numbers(first.attributes.COLOR_0) : null;
      return mesh.primitives.map((part) => part_of(gl, file, part, pictures, { base, targets, tint }));
    });
  }

  function part_of(gl, file, part, pictures, shape) {
    const material = file.json.materials[part.material], surface = material.pbrMetallicRoughness;
    const indices = file.accessor(part.indices), factor = surface.baseColorFactor || [1, 1, 1, 1];
    return {
      ...shape,
      indices: buffer_of(gl, gl.ELEMENT_ARRAY_BUFFER, file.data(part.indices)),
      count: indices.count,
      type: indices.componentType,
      colour: factor.slice(0, 3),
      opacity: factor[3],
      hole_below: material.alphaMode === "MASK" ? material.alphaCutoff : material.alphaMode === "BLEND" ? 1 / 512 : 0,
      picture: surface.baseColorTexture && pictures[surface.baseColorTexture.index],
    };
  }

  function key_times(file) {
    if (!file.json.animations) return [0];
    const data = file.data(file.json.animations[0].samplers[0].input);
    return [...new Float32Array(data.slice().buffer)];
  }

  // The ball around the bodies over the whole run: a target's bounds are those of its displacements.
  function ball(file) {
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    const bodies = file.json.meshes.filter((mesh) => mesh.extras.role === "body");
    for (const { primitives: [part] } of bodies) {
      const data = (index) => new Float32Array(file.data(index).slice().buffer);
      const base = data(part.attributes.POSITION);
      for (const moved of [null, ...(part.targets || []).map((target) => data(target.POSITION))])
        for (let k = 0; k < base.length; ++k) {
          const x = base[k] + (moved ? moved[k] : 0);
          low[k % 3] = Math.min(low[k % 3], x);
          high[k % 3] = Math.max(high[k % 3], x);
        }
    }
    const centre = low.map((x, axis) => (x + high[axis]) / 2);
    return { centre, radius: Math.max(Math.hypot(...low.map((x, axis) => high[axis] - x)) / 2, 1e-3) };
  }

  // Vectors and column-major matrices.
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  function product(a, b) {
    const c = new Float32Array(16);
    for (let j = 0; j < 4; ++j)
      for (let i = 0; i < 4; ++i) for (let k = 0; k < 4; ++k) c[4 * j + i] += a[4 * k + i] * b[4 * j + k];
    return c;
  }

  const half_angle = (20 * Math.PI) / 180; // of the shorter side
  const home = { turn: 0.5, tilt: 0.2, zoom: 0.95 };
  let camera = null;
  function reset() {
    camera = { ...home, centre: [...scene.ball.centre] };
    redraw();
  }
  // right, up and back of the camera, and where it is.
  function axes() {
    const { turn, tilt } = camera;
    const right = [Math.cos(turn), 0, -Math.sin(turn)];
    const back = [Math.sin(turn) * Math.cos(tilt), Math.sin(tilt), Math.cos(turn) * Math.cos(tilt)];
    const up = [-Math.sin(turn) * Math.sin(tilt), Math.cos(tilt), -Math.cos(turn) * Math.sin(tilt)];
    const distance = (camera.zoom * scene.ball.radius) / Math.sin(half_angle);
    return { right, up, back, distance, eye: camera.centre.map((x, axis) => x + distance * back[axis]) };
  }
  function to_clip({ right, up, back, eye, distance }) {
    const shorter = 1 / Math.tan(half_angle), aspect = canvas.width / canvas.height;
    const near = distance / 50, far = distance + 10 * scene.ball.radius;
    const projection = [shorter / Math.max(aspect, 1), 0, 0, 0, 0, shorter * Math.min(aspect, 1), 0, 0, 0, 0,
      (near + far) / (near - far), -1, 0, 0, (2 * near * far) / (near - far), 0];
    const view = [right[0], up[0], back[0], 0, right[1], up[1], back[1], 0, right[2], up[2], back[2], 0,
      -dot(right, eye), -dot(up, eye), -dot(back, eye), 1];
    return product(projection, view);
  }

  let due = false;
  function redraw() {
    if (due || !scene) return;
    due = true;
    requestAnimationFrame(() => {
      due = false;
      draw();
    });
  }

  // Where the time lies: between keys k and k + 1, `share` of the way.
  function moment() {
    const { times } = scene;
    let k = times.findLastIndex((key) => key <= time + 1e-6);
    k = clamp(k, 0, Math.max(times.length - 2, 0));
    return { k, share: times.length > 1 ? clamp((time - times[k]) / (times[k + 1] - times[k]), 0, 1) : 0 };
  }

  function bind(gl, location, buffer, size, otherwise = 0) {
    if (!buffer) {
      gl.disableVertexAttribArray(location);
      gl.vertexAttrib3f(location, otherwise, otherwise, otherwise);
      return;
    }
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.enableVertexAttribArray(location);
    gl.vertexAttribPointer(location, size, gl.FLOAT, false, 0, 0);
  }

  function draw_part(part, k) {
    const { gl, uniform } = scene;
    part.base.forEach((buffer, location) => bind(gl, location, buffer, location === 2 ? 2 : 3));
    const [before, after] = [part.targets[k - 1] || [], part.targets[k] || []];
    [before[0], before[1], after[0], after[1]].forEach((buffer, slot) => bind(gl, 3 + slot, buffer, 3));
    bind(gl, 7, part.tint, 3, 1);
    gl.uniform3fv(uniform("colour"), part.colour);
    gl.uniform1f(uniform("opacity"), part.opacity);
    gl.uniform1f(uniform("hole_below"), part.hole_below);
    gl.uniform1i(uniform("textured"), part.picture ? 1 : 0);
    gl.bindTexture(gl.TEXTURE_2D, part.picture || null);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, part.indices);
    gl.drawElements(gl.TRIANGLES, part.count, part.type, 0);
  }

  function draw() {
    const { gl, uniform } = scene;
    const density = Math.min(window.devicePixelRatio || 1, 2);
    const width = Math.round(canvas.clientWidth * density), height = Math.round(canvas.clientHeight * density);
    if (canvas.width !== width || canvas.height !== height) [canvas.width, canvas.height] = [width, height];
    gl.viewport(0, 0, width, height);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    const seen = axes(), { k, share } = moment();
    // The light comes over the viewer's left shoulder, from wherever one looks.
    const key = seen.right.map((x, axis) => -0.45 * x + 0.65 * seen.up[axis] + 0.62 * seen.back[axis]);
    gl.uniformMatrix4fv(uniform("to_clip"), false, to_clip(seen));
    gl.uniform3fv(uniform("eye"), seen.eye);
    gl.uniform3fv(uniform("centre"), scene.ball.centre);
    gl.uniform3fv(uniform("key"), key);
    gl.uniform1f(uniform("radius"), scene.ball.radius);
    gl.uniform1f(uniform("share"), share);
    for (const part of scene.parts) draw_part(part, k);
  }

  function begin() {
    // Kept, so that printing the page and copying the picture find it.
    const gl = canvas.getContext("webgl2", { alpha: true, antialias: true, preserveDrawingBuffer: true });
    if (!gl) return give_up("This browser has no WebGL 2, so the model is not shown; its file is below.");
    const file = parse(window.billow_glb);
    delete window.billow_glb;
    const program = program_of(gl), places = new Map();
    gl.useProgram(program);
    gl.enable(gl.DEPTH_TEST);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    const uniform = (name) => {
      if (!places.has(name)) places.set(name, gl.getUniformLocation(program, name));
      return places.get(name);
    };
    scene = { gl, uniform, times: key_times(file), ball: ball(file), parts: load(gl, file, redraw) };
    const keys = scene.times.length;
    state.textContent = keys > 1 ? `${keys} frames of the run, linear between them` : "one frame of the run";
    reset();
    new ResizeObserver(redraw).observe(canvas);
    canvas.addEventListener("webglcontextlost", () => give_up("The browser has dropped the model; load the page again."));
  }

  // Fingers and buttons that are down, by id.
  const held = new Map();
  const turn = (dx, dy) => {
    camera.turn -= dx;
    camera.tilt = clamp(camera.tilt + dy, -1.55, 1.55);
  };
  const zoom = (factor) => (camera.zoom = clamp(camera.zoom * factor, 0.05, 8));
  function move(dx, dy) {
    const { right, up, distance } = axes();
    const metres = (2 * distance * Math.tan(half_angle)) / Math.min(canvas.clientWidth, canvas.clientHeight);
    camera.centre = camera.centre.map((x, axis) => x + metres * (dy * up[axis] - dx * right[axis]));
  }
  canvas.addEventListener("pointerdown", (event) => {
    if (!scene) return;
    held.set(event.pointerId, { x: event.clientX, y: event.clientY, moves: event.button !== 0 || event.shiftKey });
    try {
      canvas.setPointerCapture(event.pointerId);
    } catch {} // a pointer that is up again already
  });
  canvas.addEventListener("pointermove", (event) => {
    const hold = held.get(event.pointerId);
    if (!hold) return;
    const dx = event.clientX - hold.x, dy = event.clientY - hold.y;
    const other = [...held].find(([id]) => id !== event.pointerId);
    if (other) {
      const span = (x, y) => Math.max(Math.hypot(x - other[1].x, y - other[1].y), 1);
      zoom(span(hold.x, hold.y) / span(event.clientX, event.clientY));
      move(dx / 2, dy / 2);
    } else if (hold.moves) move(dx, dy);
    else turn(0.008 * dx, 0.008 * dy);
    Object.assign(hold, { x: event.clientX, y: event.clientY });
    redraw();
  });
  for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, (event) => held.delete(event.pointerId));
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("dblclick", () => scene && reset());
  canvas.addEventListener("wheel", (event) => {
    if (!scene) return;
    event.preventDefault();
    zoom(Math.exp(0.0015 * event.deltaY * (event.deltaMode === 1 ? 16 : 1)));
    redraw();
  }, { passive: false });
  canvas.addEventListener("keydown", (event) => {
    const keys = { ArrowLeft: () => turn(-0.1, 0), ArrowRight: () => turn(0.1, 0), ArrowUp: () => turn(0, -0.1),
      ArrowDown: () => turn(0, 0.1), "+": () => zoom(0.9), "=": () => zoom(0.9), "-": () => zoom(1 / 0.9), Home: reset };
    if (!scene || !keys[event.key] || event.altKey || event.ctrlKey || event.metaKey) return;
    keys[event.key]();
    redraw();
    event.preventDefault();
    event.stopPropagation(); // the player steps by arrows, too
  });

  // Its slider and button are the player's.
  const slider = document.getElementById("frame"), own_slider = document.getElementById("scene-frame");
  const play = document.getElementById("play"), own_play = document.getElementById("scene-play");
  own_slider.min = slider.min;
  own_slider.max = slider.max;
  own_slider.addEventListener("input", () => {
    slider.value = own_slider.value;
    slider.dispatchEvent(new Event("input", { bubbles: true }));
  });
  own_play.addEventListener("click", () => play.click());
  new MutationObserver(() => own_play.setAttribute("aria-pressed", play.getAttribute("aria-pressed"))).observe(play, { attributes: true });
  document.addEventListener("billow-time", (event) => {
    time = event.detail;
    own_slider.value = slider.value;
    own_slider.setAttribute("aria-valuetext", slider.getAttribute("aria-valuetext"));
    redraw();
  });

  // The model may be large: it is loaded when it comes into view.
  new IntersectionObserver((entries, observer) => {
    if (!entries.some((entry) => entry.isIntersecting)) return;
    observer.disconnect();
    const script = document.createElement("script");
    script.src = section.dataset.script;
    script.onload = begin;
    script.onerror = () => give_up(`${section.dataset.script} is missing, so the model is not shown.`);
    document.head.append(script);
  }, { rootMargin: "600px" }).observe(section);
})();
