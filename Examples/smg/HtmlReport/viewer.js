// SPDX-License-Identifier: BSD-3-Clause
// Draws the surface of the page with WebGL 2, and lets the user turn it and choose its colour. The
// page says what is missing; this script takes that back when the first picture has been drawn.
(() => {
  "use strict";
  const figure = document.querySelector(".view");
  const canvas = figure.querySelector("canvas");
  const control = (name) => figure.querySelector(`[name=${name}]`);
  const gl = canvas.getContext("webgl2", { antialias: true });
  if (!gl) {
    return;
  }
  const surface = JSON.parse(document.getElementById("surface").textContent);
  const decode = (Type, text) => new Type(Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer);

  // The shaders. Both sides are lit, as scans are wound in either way.
  const vertexShader = `#version 300 es
    uniform mat4 view, projection;
    layout(location = 0) in vec3 position;
    layout(location = 1) in vec3 normal; // not of length 1
    layout(location = 2) in vec2 value; // from 0 to 1, and whether it is missing
    layout(location = 3) in vec3 colour;
    out vec3 place, direction, rgb;
    out vec2 number;
    void main() {
      vec4 seen = view * vec4(position, 1.0);
      place = seen.xyz;
      direction = mat3(view) * normal;
      number = value;
      rgb = colour;
      gl_Position = projection * seen;
    }`;
  const fragmentShader = `#version 300 es
    precision highp float;
    uniform int mode; // 0: the surface alone, 1: numbers, 2: colours
    uniform vec3 ramp[11];
    uniform vec2 contours; // the first one and their distance; 0: none
    in vec3 place, direction, rgb;
    in vec2 number;
    out vec4 pixel;
    vec3 rampAt(float share) {
      float x = clamp(share, 0.0, 1.0) * 10.0;
      int i = min(int(x), 9);
      return mix(ramp[i], ramp[i + 1], x - float(i));
    }
    void main() {
      vec3 eye = normalize(-place);
      vec3 face = cross(dFdx(place), dFdy(place));
      face = dot(face, eye) < 0.0 ? -face : face;
      vec3 n = normalize(direction);
      n = dot(n, face) < 0.0 ? -n : n;
      vec3 base = vec3(0.74, 0.73, 0.70);
      float line = (number.x - contours.x) / max(contours.y, 1e-9);
      float width = fwidth(line);
      if (mode == 2) {
        base = rgb;
      } else if (mode == 1 && number.y == 0.0) {
        base = rampAt(number.x);
        // None on a plateau, which may lie at the number of a line, as those of conditions do.
        if (contours.y > 0.0 && width > 1e-5 && abs(number.x - 0.5) < 0.4995) {
          base *= mix(0.4, 1.0, smoothstep(0.5, 1.5, abs(fract(line - 0.5) - 0.5) / width));
        }
      }
      vec3 key = normalize(vec3(-0.35, 0.55, 0.75));
      float light = 0.46 + 0.60 * max(dot(n, key), 0.0) + 0.16 * max(dot(n, vec3(0.8, -0.2, 0.5)), 0.0);
      float shine = 0.10 * pow(max(dot(reflect(-key, n), eye), 0.0), 20.0);
      pixel = vec4(base * light + shine, 1.0);
    }`;
  const program = gl.createProgram();
  for (const [kind, source] of [[gl.VERTEX_SHADER, vertexShader], [gl.FRAGMENT_SHADER, fragmentShader]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) {
    return;
  }
  gl.useProgram(program);
  gl.enable(gl.DEPTH_TEST);
  const uniform = (name) => gl.getUniformLocation(program, name);

  // From cool to warm (Moreland 2009): never so dark that the shading is lost, and clear to the colour-blind.
  const ramp = ["3b4cc0", "5977e3", "7b9ff9", "9ebeff", "c0d4f5", "dddcdc", "f2cbb7", "f7ac8e", "ee8468", "d65244", "b40426"];
  gl.uniform3fv(uniform("ramp"), ramp.flatMap((hex) => [0, 2, 4].map((i) => parseInt(hex.substr(i, 2), 16) / 255)));
  figure.querySelector(".ramp").style.background = `linear-gradient(to right, ${ramp.map((hex) => "#" + hex)})`;

  const corners = decode(Uint16Array, surface.corners);
  const positions = decode(Float32Array, surface.positions);
  const attribute = (place, array, size, type, normalized) => {
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, array, gl.STATIC_DRAW);
    gl.enableVertexAttribArray(place);
    gl.vertexAttribPointer(place, size, type, normalized, 0, 0);
  };
  /** The values of points, `size` each, for the corners of all triangles. */
  const atCorners = (values, size) => {
    const all = new values.constructor(corners.length * size);
    corners.forEach((point, corner) => {
      for (let k = 0; k < size; ++k) {
        all[corner * size + k] = values[point * size + k];
      }
    });
    return all;
  };
  /** The normals of corners: the mean, by areas, of those triangles around the point that the surface does not
   * turn from by more than 40 degrees. So bodies have their edges, and everything else is smooth. */
  function cornerNormals() {
    const normals = new Float32Array(3 * corners.length), faces = new Float32Array(corners.length);
    const around = Array.from({ length: positions.length / 3 }, () => []);
    const dot = (t, u) => faces[t] * faces[u] + faces[t + 1] * faces[u + 1] + faces[t + 2] * faces[u + 2];
    for (let t = 0; t < corners.length; t += 3) {
      const [a, b, c] = [0, 1, 2].map((k) => positions.subarray(3 * corners[t + k], 3 * corners[t + k] + 3));
      for (let k = 0; k < 3; ++k) {
        const [m, n] = [(k + 1) % 3, (k + 2) % 3];
        faces[t + k] = (b[m] - a[m]) * (c[n] - a[n]) - (b[n] - a[n]) * (c[m] - a[m]);
        around[corners[t + k]].push(t);
      }
    }
    const lengths = faces.map((_, t) => t % 3 ? 0 : Math.sqrt(dot(t, t)));
    corners.forEach((point, corner) => {
      const t = corner - corner % 3;
      for (const u of around[point]) {
        // Neighbours may be wound in the other way.
        const cosine = dot(t, u) / (lengths[t] * lengths[u]);
        for (let k = 0; k < 3 && Math.abs(cosine) > 0.766; ++k) {
          normals[3 * corner + k] += Math.sign(cosine) * faces[u + k];
        }
      }
    });
    return normals;
  }
  // In the unit of the bounds: areas of small bodies would be no numbers in single precision.
  const extents = [0, 1, 2].map((k) => surface.bounds[2 * k + 1] - surface.bounds[2 * k]);
  const radius = Math.hypot(...extents) / 2 || 1;
  positions.forEach((x, i) => { positions[i] = x / radius; });
  attribute(0, atCorners(positions, 3), 3, gl.FLOAT, false);
  attribute(1, cornerNormals(), 3, gl.FLOAT, false);

  const pretty = (value) => String(Number(value.toPrecision(6)));
  /** 1, 2 or 5 times a power of ten: about a tenth of the range. */
  const tidyStep = (range) => {
    const power = 10 ** Math.floor(Math.log10(range / 10));
    return [1, 2, 5, 10].map((factor) => factor * power).find((step) => range / step <= 14);
  };
  function showColumn() {
    const column = surface.columns[control("column").value];
    figure.querySelector(".bar").hidden = !column || column.isColour;
    control("contours").parentElement.hidden = !column || column.isColour || !(column.most > column.least);
    gl.uniform1i(uniform("mode"), !column ? 0 : column.isColour ? 2 : 1);
    gl.disableVertexAttribArray(2);
    gl.disableVertexAttribArray(3);
    gl.uniform2f(uniform("contours"), 0, 0);
    if (column && column.isColour) {
      attribute(3, atCorners(decode(Uint8Array, column.values), 3), 3, gl.UNSIGNED_BYTE, true);
    } else if (column) {
      const values = decode(Uint16Array, column.values);
      attribute(2, atCorners(Float32Array.from({ length: 2 * values.length }, (_, i) => {
        const missing = values[i >> 1] === 65535;
        return i % 2 ? Number(missing) : missing ? 0 : values[i >> 1] / 65534;
      }), 2), 2, gl.FLOAT, false);
      figure.querySelector(".least").textContent = pretty(column.least);
      figure.querySelector(".most").textContent = pretty(column.most);
      const range = column.most - column.least;
      if (control("contours").checked && range > 0) {
        const step = tidyStep(range);
        gl.uniform2f(uniform("contours"), (Math.ceil(column.least / step) * step - column.least) / range, step / range);
        control("contours").nextSibling.textContent = ` contour lines every ${pretty(step)}`;
      }
    }
    redraw();
  }

  // The camera: it looks at the centre, from `distance` radii of the bounds.
  const isFlat = extents[2] < 0.5 * Math.min(extents[0], extents[1]);
  const camera = {};
  const opening = 1 / Math.tan(0.3); // of half the field of view
  /** Shows all points. */
  function resetCamera() {
    Object.assign(camera, { yaw: -0.5, pitch: isFlat ? 0.7 : 0.25, distance: 0, x: 0, y: 0 });
    const matrix = viewMatrix(), aspect = canvas.clientWidth / canvas.clientHeight;
    for (let i = 0; i < positions.length; i += 3) {
      const [x, y, z] = [0, 1, 2].map((row) =>
        matrix[row] * positions[i] + matrix[4 + row] * positions[i + 1] + matrix[8 + row] * positions[i + 2]);
      camera.distance = Math.max(camera.distance, z + 1.1 * opening * Math.max(Math.abs(y), Math.abs(x) / aspect));
    }
  }
  const clamp = (value, least, most) => Math.min(Math.max(value, least), most);

  /** The axes of the mesh that point right, up and to the viewer, turned and moved; by columns. */
  function viewMatrix() {
    const axes = { x: [[0, 0, 1], [1, 0, 0], [0, 1, 0]], y: [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
      z: [[1, 0, 0], [0, 0, 1], [0, -1, 0]] }[control("up").value];
    const [sy, cy, sp, cp] = [Math.sin(camera.yaw), Math.cos(camera.yaw), Math.sin(camera.pitch), Math.cos(camera.pitch)];
    const turn = [[cy, 0, sy], [sp * sy, cp, -sp * cy], [-cp * sy, sp, cp * cy]];
    const entry = (row, k) => [0, 1, 2].reduce((sum, m) => sum + turn[row][m] * axes[m][k], 0);
    return [0, 1, 2].flatMap((k) => [entry(0, k), entry(1, k), entry(2, k), 0])
      .concat(camera.x, camera.y, -camera.distance, 1);
  }

  function draw() {
    const scale = Math.min(window.devicePixelRatio || 1, 2);
    const [width, height] = [canvas.clientWidth, canvas.clientHeight].map((size) => Math.max(1, Math.round(size * scale)));
    if (canvas.width !== width || canvas.height !== height) {
      [canvas.width, canvas.height] = [width, height];
    }
    gl.viewport(0, 0, width, height);
    const [near, far] = [Math.max(camera.distance - 1.5, 0.01), camera.distance + 1.5];
    const depth = 1 / (near - far);
    gl.uniformMatrix4fv(uniform("projection"), false, [opening * height / width, 0, 0, 0, 0, opening, 0, 0,
      0, 0, (near + far) * depth, -1, 0, 0, 2 * near * far * depth, 0]);
    gl.uniformMatrix4fv(uniform("view"), false, viewMatrix());
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.drawArrays(gl.TRIANGLES, 0, corners.length);
  }
  let isAwaited = false;
  function redraw() {
    if (!isAwaited) {
      isAwaited = true;
      requestAnimationFrame(() => { isAwaited = false; draw(); });
    }
  }

  // Mouse and touch: one pointer turns, two move and zoom.
  const pointers = new Map();
  const turn = (dx, dy) => {
    camera.yaw += dx;
    camera.pitch = clamp(camera.pitch + dy, -Math.PI / 2, Math.PI / 2);
  };
  const move = (dx, dy) => {
    const unit = camera.distance * 0.62 / canvas.clientHeight;
    camera.x += dx * unit;
    camera.y -= dy * unit;
  };
  const zoom = (factor) => { camera.distance = clamp(camera.distance * factor, 0.3, 20); };
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, event);
  });
  canvas.addEventListener("pointermove", (event) => {
    const before = pointers.get(event.pointerId);
    if (!before) {
      return;
    }
    const [dx, dy] = [event.clientX - before.clientX, event.clientY - before.clientY];
    const other = [...pointers.values()].find((pointer) => pointer.pointerId !== event.pointerId);
    if (other) {
      const apart = (pointer) => Math.hypot(pointer.clientX - other.clientX, pointer.clientY - other.clientY) || 1;
      zoom(apart(before) / apart(event));
      move(dx / 2, dy / 2);
    } else if (event.shiftKey || event.buttons & 6) {
      move(dx, dy);
    } else {
      turn(dx * 0.008, dy * 0.008);
    }
    pointers.set(event.pointerId, event);
    redraw();
  });
  for (const end of ["pointerup", "pointercancel"]) {
    canvas.addEventListener(end, (event) => pointers.delete(event.pointerId));
  }
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("wheel", (event) => {
    // A page that is scrolled past the picture is not held up by it.
    if (document.activeElement === canvas || event.ctrlKey) {
      event.preventDefault();
      zoom(Math.exp(clamp(event.deltaY, -100, 100) * 0.002));
      redraw();
    }
  }, { passive: false });
  canvas.addEventListener("keydown", (event) => {
    const keys = { ArrowLeft: () => turn(-0.1, 0), ArrowRight: () => turn(0.1, 0), ArrowUp: () => turn(0, -0.1),
      ArrowDown: () => turn(0, 0.1), "+": () => zoom(0.9), "-": () => zoom(1.1) };
    if (keys[event.key]) {
      event.preventDefault();
      keys[event.key]();
      redraw();
    }
  });

  const addOption = (value, text) => control("column").append(new Option(text, value));
  addOption(-1, "none");
  surface.columns.forEach((column, i) => addOption(i, column.name));
  control("column").value = surface.shown;
  control("column").parentElement.hidden = surface.columns.length === 0;
  // As is usual for scans, and for terrain and parts of machines.
  control("up").value = isFlat || surface.isSolid ? "z" : "y";
  control("column").addEventListener("change", showColumn);
  control("contours").addEventListener("change", showColumn);
  control("up").addEventListener("change", redraw);
  figure.querySelector("button").addEventListener("click", () => { resetCamera(); redraw(); });
  canvas.hidden = false;
  resetCamera();
  showColumn();
  draw();
  // Some browsers offer WebGL and draw nothing: the picture must have pixels of the surface.
  const pixels = new Uint8Array(canvas.width * canvas.height * 4);
  gl.readPixels(0, 0, canvas.width, canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  const drawn = pixels.filter((_, i) => i % 4 === 3 && pixels[i] > 0).length;
  canvas.dataset.drawn = drawn;
  canvas.hidden = drawn === 0;
  figure.querySelector(".absent").hidden = drawn > 0;
  figure.querySelector(".controls").hidden = drawn === 0;
  new ResizeObserver(redraw).observe(canvas);
})();
