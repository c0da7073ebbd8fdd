/* The interactive view of a report: bodies of a 3D run with a field, a cut, enlarged displacements and load steps.
   Uses THREE and THREE.OrbitControls. The data are described in data.py. */
"use strict";
(function () {
  const MISSING = 65535;
  const MOST_SAFETY = 5; // safety factor at which the scale ends, since factors of places without load are very large
  const GREY = [0.75, 0.75, 0.75];
  const SMOOTH = Math.cos(40 * Math.PI / 180); // normals that differ by less belong to one smooth surface

  /* Numbers */

  function bytes(text) {
    const found = atob(text), result = new Uint8Array(found.length);
    for (let i = 0; i < found.length; ++i) result[i] = found.charCodeAt(i);
    return result.buffer;
  }
  const codes = text => new Uint16Array(bytes(text));
  const integers = of => of.bits === 32 ? new Uint32Array(bytes(of.data)) : codes(of.data);

  /* Values of rows of three; NaN where there is none. */
  function vectors(of, text) {
    const found = codes(text), result = new Float32Array(found.length);
    for (let i = 0; i < found.length; ++i) result[i] = of.low[i % 3] + of.step[i % 3] * found[i];
    return result;
  }
  function scalars(of, text) {
    const found = codes(text), result = new Float32Array(found.length);
    for (let i = 0; i < found.length; ++i) result[i] = found[i] === MISSING ? NaN : of.low + of.step * found[i];
    return result;
  }

  function shortNumber(value) {
    if (value === 0) return "0";
    const size = Math.abs(value);
    const text = size >= 1e5 || size < 1e-3 ? value.toExponential(2) : String(Number(value.toPrecision(4)));
    return text.replace("-", "\u2212");
  }

  /* Colours: the same tables as in the pictures, 256 rows of red, green, blue. */
  function colourTexture(text, reversed) {
    const rgb = new Uint8Array(bytes(text)), data = new Uint8Array(4 * 256);
    for (let i = 0; i < 256; ++i) {
      const from = reversed ? 255 - i : i;
      for (let k = 0; k < 3; ++k) data[4 * i + k] = rgb[3 * from + k];
      data[4 * i + 3] = 255;
    }
    const texture = new THREE.DataTexture(data, 256, 1, THREE.RGBAFormat);
    texture.magFilter = texture.minFilter = THREE.LinearFilter;
    texture.needsUpdate = true;
    return texture;
  }

  const VERTEX = `
    attribute vec3 shift;
    attribute float value;
    uniform float enlargement;
    varying vec3 place;
    varying vec3 turned;
    varying float amount;
    void main() {
      place = position;
      amount = value;
      turned = normalMatrix * normal;
      gl_Position = projectionMatrix * modelViewMatrix * vec4(position + enlargement * shift, 1.0);
    }`;
  const CLIP = `
    uniform vec4 plane;
    uniform float least;
    uniform float largest;
    varying vec3 place;
    varying vec3 turned;
    varying float amount;
    float fraction() { return clamp((amount - least) / (largest - least), 0.0, 1.0); }
    void clip() { if (dot(plane.xyz, place) > plane.w) discard; }`;
  const FRAGMENT = CLIP + `
    uniform sampler2D colours;
    uniform float plain;
    uniform float opacity;
    void main() {
      clip();
      vec3 colour = vec3(${GREY.join(", ")});
      if (plain < 0.5 && amount > -1e29) colour = texture2D(colours, vec2((0.5 + 255.0 * fraction()) / 256.0, 0.5)).rgb;
      float light = length(turned) > 0.0 ? 0.76 + 0.24 * abs(normalize(turned).z) : 1.0;
      if (!gl_FrontFacing && length(turned) > 0.0) { colour = vec3(0.55); light = 1.0; }
      gl_FragColor = vec4(light * colour, opacity);
    }`;
  /* What is under the pointer: number of the part in two bytes, value in two bytes. */
  const PICK = CLIP + `
    uniform float part;
    void main() {
      clip();
      float code = amount > -1e29 ? floor(fraction() * 65534.0 + 0.5) : 65535.0;
      gl_FragColor = vec4(floor(part / 256.0) / 255.0, mod(part, 256.0) / 255.0, floor(code / 256.0) / 255.0, mod(code, 256.0) / 255.0);
    }`;
  const LINE = CLIP + `
    void main() { clip(); gl_FragColor = vec4(0.08, 0.08, 0.08, 1.0); }`;

  /* Normals at the corners of triangles, smooth where those of neighbours nearly agree. */
  function cornerNormals(points, triangles) {
    const count = triangles.length / 3, flat = new Float32Array(3 * count), at = new Map(), result = new Float32Array(3 * triangles.length);
    for (let t = 0; t < count; ++t) {
      const [a, b, c] = [0, 1, 2].map(k => 3 * triangles[3 * t + k]);
      const u = [0, 1, 2].map(k => points[b + k] - points[a + k]), v = [0, 1, 2].map(k => points[c + k] - points[a + k]);
      const n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
      const size = Math.hypot(n[0], n[1], n[2]) || 1;
      for (let k = 0; k < 3; ++k) {
        flat[3 * t + k] = n[k] / size;
        const vertex = triangles[3 * t + k];
        if (at.has(vertex)) at.get(vertex).push(t); else at.set(vertex, [t]);
      }
    }
    for (let i = 0; i < triangles.length; ++i) {
      const own = 3 * Math.floor(i / 3), sum = [0, 0, 0];
      for (const t of at.get(triangles[i])) {
        const other = 3 * t;
        if (flat[own] * flat[other] + flat[own + 1] * flat[other + 1] + flat[own + 2] * flat[other + 2] < SMOOTH) continue;
        for (let k = 0; k < 3; ++k) sum[k] += flat[other + k];
      }
      const size = Math.hypot(sum[0], sum[1], sum[2]) || 1;
      for (let k = 0; k < 3; ++k) result[3 * i + k] = sum[k] / size;
    }
    return result;
  }

  /* Geometry of triangles with separate corners: `vertices`: number of the vertex of each corner. */
  class Corners {
    constructor(points, vertices, normals) {
      this.vertices = vertices;
      this.geometry = new THREE.BufferGeometry();
      const place = new Float32Array(3 * vertices.length);
      gather(points, vertices, place);
      this.set("position", place, 3);
      this.set("normal", normals || new Float32Array(3 * vertices.length), 3);
      this.set("shift", new Float32Array(3 * vertices.length), 3);
      this.set("value", new Float32Array(vertices.length), 1);
    }
    set(name, array, size) { this.geometry.setAttribute(name, new THREE.BufferAttribute(array, size)); }
    array(name) { return this.geometry.attributes[name].array; }
    shift(displacement) {
      gather(displacement, this.vertices, this.array("shift"));
      this.geometry.attributes.shift.needsUpdate = true;
    }
    /* Normals of a body that turns. `matrix`: its rotation, by rows */
    turn(matrix) {
      const found = this.array("normal");
      if (!this.drawn) this.drawn = found.slice();
      for (let i = 0; i < found.length; i += 3)
        for (let k = 0; k < 3; ++k)
          found[i + k] = matrix[3 * k] * this.drawn[i] + matrix[3 * k + 1] * this.drawn[i + 1] + matrix[3 * k + 2] * this.drawn[i + 2];
      this.geometry.attributes.normal.needsUpdate = true;
    }
    /* `numbers`: of the vertices, or of the cells of corners. A triangle without a value at one of its corners has none. */
    value(values, numbers) {
      const found = this.array("value");
      for (let i = 0; i < numbers.length; i += 3) {
        const known = [0, 1, 2].every(k => !isNaN(values[numbers[i + k]]));
        for (let k = 0; k < 3; ++k) found[i + k] = known ? values[numbers[i + k]] : -1e30;
      }
      this.geometry.attributes.value.needsUpdate = true;
    }
  }

  function gather(rows, numbers, into) {
    for (let i = 0; i < numbers.length; ++i)
      for (let k = 0; k < 3; ++k) into[3 * i + k] = rows[3 * numbers[i] + k];
  }

  const repeated = (owners, times) => {
    const result = new Uint32Array(owners.length * times);
    for (let i = 0; i < result.length; ++i) result[i] = owners[Math.floor(i / times)];
    return result;
  };

  /* The plane section of cells, by body: arrays of positions, displacements and values, three corners per triangle.
     A cell is split into tetrahedra about its centre and the centres of its quadrilaterals, which neighbours share. */
  function section(view, axis, level) {
    const found = view.data.bodies.map(() => ({ position: [], shift: [], value: [] }));
    const points = view.points, shifts = view.shifts, atPoints = view.field.place === "point", values = view.values;
    const row = (vertices, scale) => {
      const sum = new Array(7).fill(0);
      for (const vertex of vertices) {
        for (let k = 0; k < 3; ++k) { sum[k] += points[3 * vertex + k]; sum[3 + k] += shifts[3 * vertex + k]; }
        sum[6] += atPoints ? values[vertex] : 0;
      }
      return sum.map(part => part / scale);
    };
    for (const block of view.cells) {
      const n = block.vertices;
      for (let c = 0; c < block.owners.length; ++c) {
        let low = Infinity, high = -Infinity;
        for (let k = 0; k < n; ++k) {
          const along = points[3 * block.nodes[n * c + k] + axis];
          low = Math.min(low, along);
          high = Math.max(high, along);
        }
        if (low > level || high < level) continue;
        const owner = block.owners[c], nodes = Array.from(block.nodes.subarray(n * c, n * c + n));
        const rows = nodes.map(node => row([node], 1)), into = found[view.cellBodies[owner]];
        const own = atPoints ? null : values[owner];
        if (n === 4) cutTetrahedron(rows, axis, level, own, into);
        else {
          const centre = row(nodes, n);
          for (const face of block.faces) {
            if (face.length === 3) { cutTetrahedron([...face.map(k => rows[k]), centre], axis, level, own, into); continue; }
            const middle = row(face.map(k => nodes[k]), 4);
            for (let k = 0; k < 4; ++k) cutTetrahedron([rows[face[k]], rows[face[(k + 1) % 4]], middle, centre], axis, level, own, into);
          }
        }
      }
    }
    return found;
  }

  function cutTetrahedron(rows, axis, level, own, into) {
    const above = [], below = [];
    for (const row of rows) (row[axis] >= level ? above : below).push(row);
    if (!above.length || !below.length) return;
    const between = (a, b) => {
      const t = (level - a[axis]) / (b[axis] - a[axis]);
      return a.map((part, k) => part + t * (b[k] - part));
    };
    const corners = [];
    if (above.length === 2) {
      const [[a, b], [c, d]] = [above, below];
      const quad = [between(a, c), between(a, d), between(b, d), between(b, c)];
      corners.push(quad[0], quad[1], quad[2], quad[0], quad[2], quad[3]);
    } else {
      const [tip, others] = above.length === 1 ? [above[0], below] : [below[0], above];
      for (const other of others) corners.push(between(tip, other));
    }
    for (let i = 0; i < corners.length; i += 3) {
      const known = own === null ? corners.slice(i, i + 3).every(row => !isNaN(row[6])) : !isNaN(own);
      for (let k = 0; k < 3; ++k) {
        const row = corners[i + k];
        into.position.push(row[0], row[1], row[2]);
        into.shift.push(row[3], row[4], row[5]);
        into.value.push(known ? own === null ? row[6] : own : -1e30);
      }
    }
  }

  class View {
    constructor(root, data) {
      this.root = root;
      this.data = data;
      this.canvas = root.querySelector("canvas.scene");
      this.renderer = new THREE.WebGLRenderer({ canvas: this.canvas, antialias: true, preserveDrawingBuffer: true });
      this.renderer.setClearColor(0xffffff, 1);
      this.renderer.autoClear = false;
      this.scene = new THREE.Scene();
      this.front = new THREE.Scene(); // contact surfaces, drawn over the bodies that hide them
      this.enlargement = data.enlargement;
      this.read();
      this.materials();
      this.meshes();
      this.cameras();
      this.controls();
      this.setFrame(data.first);
      this.setField(data.fields.length > 1 ? data.fields[1].name : data.fields[0].name);
      this.resize();
    }

    read() {
      const data = this.data;
      this.points = vectors(data.points, data.points.data);
      this.triangles = integers(data.triangles);
      this.owners = integers(data.owners);
      this.cellBodies = integers(data.cellBodies);
      this.creases = integers(data.creases);
      this.creaseBodies = integers(data.creaseBodies);
      this.cells = data.cells.map(block => ({ vertices: block.vertices, faces: block.faces, nodes: integers(block.nodes), owners: integers(block.owners) }));
      const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
      for (let i = 0; i < this.points.length; ++i) {
        low[i % 3] = Math.min(low[i % 3], this.points[i]);
        high[i % 3] = Math.max(high[i % 3], this.points[i]);
      }
      this.box = { low, high }; // box of the undeformed bodies, for cuts
      this.all = [...data.fields, ...(data.contacts ? data.contacts.fields : [])];
    }

    materials() {
      const shared = {
        enlargement: { value: 0 }, plane: { value: new THREE.Vector4(0, 0, 0, 1) }, least: { value: 0 }, largest: { value: 1 },
        colours: { value: null }, plain: { value: 0 }, opacity: { value: 1 }
      };
      this.shared = shared;
      this.tables = {
        magnitude: colourTexture(this.data.colours.magnitude, false), signed: colourTexture(this.data.colours.signed, false),
        reversed: colourTexture(this.data.colours.magnitude, true)
      };
      const uncut = { value: new THREE.Vector4(0, 0, 0, 1) };
      const solid = own => ({ ...shared, ...own });
      const make = (fragment, uniforms, more) => new THREE.ShaderMaterial({ vertexShader: VERTEX, fragmentShader: fragment, uniforms, side: THREE.DoubleSide, ...more });
      const behind = { polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 }; // the edges
      this.drawn = make(FRAGMENT, solid({}), behind);
      this.onPlane = make(FRAGMENT, solid({ plane: uncut }), behind);
      this.onContact = make(FRAGMENT, solid({ plain: { value: 0 }, opacity: { value: 1 } }));
      this.edge = make(LINE, solid({}));
      this.picked = (part, cut) => make(PICK, solid({ part: { value: part }, ...(cut ? { plane: uncut } : {}) }));
    }

    meshes() {
      const data = this.data;
      this.parts = data.bodies.map((name, body) => {
        const from = data.starts[body], to = data.starts[body + 1];
        const vertices = this.triangles.subarray(3 * from, 3 * to);
        const corners = new Corners(this.points, vertices, cornerNormals(this.points, vertices));
        corners.owners = repeated(this.owners.subarray(from, to), 3);
        const ends = [];
        for (let e = 0; e < this.creaseBodies.length; ++e) if (this.creaseBodies[e] === body) ends.push(this.creases[2 * e], this.creases[2 * e + 1]);
        const lines = new Corners(this.points, Uint32Array.from(ends));
        const part = { name, corners, lines, number: body, visible: true };
        part.mesh = this.add(new THREE.Mesh(corners.geometry, this.drawn));
        part.edges = this.add(new THREE.LineSegments(lines.geometry, this.edge));
        part.section = this.add(new THREE.Mesh(new THREE.BufferGeometry(), this.onPlane));
        part.section.visible = false;
        part.picks = [this.picked(body, false), this.picked(body, true)];
        return part;
      });
      this.faces = [];
      if (!data.contacts) return;
      this.faces = data.contacts.names.map((name, k) => {
        const part = { name, number: data.bodies.length + k };
        part.mesh = this.add(new THREE.Mesh(new THREE.BufferGeometry(), this.onContact), this.front);
        part.mesh.visible = false;
        part.picks = [this.picked(part.number, false)];
        return part;
      });
      this.shapeContacts(data.contacts.shapes[0]);
    }

    /* The contact surfaces of a load step: the pairs of bodies that move far differ from step to step. */
    shapeContacts(shape) {
      if (shape === this.shape) return;
      this.shape = shape;
      const points = vectors(shape.points, shape.points.data), triangles = integers(shape.triangles);
      this.faces.forEach((part, k) => {
        part.corners = new Corners(points, triangles.subarray(3 * shape.starts[k], 3 * shape.starts[k + 1]), null);
        part.mesh.geometry.dispose();
        part.mesh.geometry = part.corners.geometry;
      });
    }

    add(object, scene = this.scene) {
      object.frustumCulled = false;
      scene.add(object);
      return object;
    }

    cameras() {
      const { low, high } = this.data.reach;
      this.centre = new THREE.Vector3(...[0, 1, 2].map(k => 0.5 * (low[k] + high[k])));
      this.radius = 0.5 * Math.hypot(...[0, 1, 2].map(k => high[k] - low[k])) || 1;
      this.camera = new THREE.OrthographicCamera(-1, 1, 1, -1, 0.01 * this.radius, 40 * this.radius);
      this.camera.up.set(0, 0, 1);
      this.orbit = new THREE.OrbitControls(this.camera, this.canvas);
      this.orbit.addEventListener("change", () => this.request());
      this.lookFrom(1, -1.4, 0.9);
    }

    lookFrom(x, y, z) {
      this.camera.position.copy(this.centre).add(new THREE.Vector3(x, y, z).normalize().multiplyScalar(10 * this.radius));
      this.orbit.target.copy(this.centre);
      this.orbit.update();
      this.camera.updateMatrixWorld();
      this.fit();
      this.request();
    }

    /* Enlarges the image until the box around the bodies of all load steps fills the canvas. */
    fit(zoomed = 1) {
      const { low, high } = this.data.reach, camera = this.camera, turn = camera.matrixWorldInverse;
      let wide = 0, tall = 0;
      for (let corner = 0; corner < 8; ++corner) {
        const place = new THREE.Vector3(...[0, 1, 2].map(k => corner >> k & 1 ? high[k] : low[k])).applyMatrix4(turn);
        wide = Math.max(wide, Math.abs(place.x));
        tall = Math.max(tall, Math.abs(place.y));
      }
      this.fitted = 0.88 * Math.min(camera.right / (wide || 1), camera.top / (tall || 1));
      camera.zoom = zoomed * this.fitted;
      camera.updateProjectionMatrix();
    }

    /* What the user chooses */

    setFrame(number) {
      const data = this.data;
      this.frame = Math.max(0, Math.min(data.frames.length - 1, number));
      this.shifts = vectors(data.displacement, data.displacement.frames[this.frame]);
      for (const part of this.parts) for (const of of [part.corners, part.lines]) of.shift(this.shifts);
      if (data.turns) this.parts.forEach((part, body) => part.corners.turn(data.turns[this.frame][body]));
      if (data.contacts) {
        this.shapeContacts(data.contacts.shapes[data.contacts.shapes.length > 1 ? this.frame : 0]);
        const shifts = vectors(data.contacts.displacement, data.contacts.displacement.frames[this.frame]);
        for (const part of this.faces) part.corners.shift(shifts);
      }
      if (this.field) this.update();
      this.show();
    }

    setField(name) {
      this.field = this.all.find(field => field.name === name) || this.all[0];
      const { least, largest, signed, factor } = this.field;
      const most = Math.max(Math.abs(least), Math.abs(largest));
      this.range = signed && least < 0 ? [-most, most] : [Math.min(0, least), largest];
      if (this.field.reversed) this.range = [0, Math.min(largest, MOST_SAFETY)];
      if (!(this.range[1] > this.range[0])) this.range[1] = this.range[0] + 1 / factor;
      this.update();
      this.show();
    }

    update() {
      const field = this.field, onContact = field.place === "pair";
      this.values = scalars(field, field.frames[this.frame]);
      if (onContact) for (const part of this.faces) part.corners.value(this.values, part.corners.vertices);
      else for (const part of this.parts) part.corners.value(this.values, field.place === "point" ? part.corners.vertices : part.corners.owners);
      this.cutAgain();
    }

    setRange(least, largest) {
      if (largest > least) this.range = [least, largest];
      this.show();
    }

    setEnlargement(factor) {
      this.enlargement = Math.max(0, factor);
      this.show();
    }

    /* axis: 0, 1, 2, or -1 for none; fraction: of the extent of the bodies; other: keep the side that the first view shows */
    setCut(axis, fraction, other) {
      this.cut = axis < 0 ? null : { axis, level: this.box.low[axis] + fraction * (this.box.high[axis] - this.box.low[axis]), other: Boolean(other) };
      const sign = (axis === 1) === Boolean(other) ? 1 : -1, plane = this.shared.plane.value;
      if (this.cut) plane.set(...[0, 1, 2].map(k => k === axis ? sign : 0), sign * this.cut.level);
      else plane.set(0, 0, 0, 1);
      this.element("axis").value = axis;
      this.element("level").value = fraction;
      this.element("other").checked = Boolean(other);
      this.cutAgain();
      this.show();
    }

    cutAgain() {
      const shown = this.cut && this.field && this.field.place !== "pair" && this.cells.length;
      const found = shown ? section(this, this.cut.axis, this.cut.level) : null;
      this.parts.forEach((part, body) => {
        if (found) {
          const geometry = new THREE.BufferGeometry(), of = found[body];
          geometry.setAttribute("position", new THREE.BufferAttribute(Float32Array.from(of.position), 3));
          geometry.setAttribute("shift", new THREE.BufferAttribute(Float32Array.from(of.shift), 3));
          geometry.setAttribute("value", new THREE.BufferAttribute(Float32Array.from(of.value), 1));
          geometry.setAttribute("normal", new THREE.BufferAttribute(new Float32Array(of.position.length), 3));
          part.section.geometry.dispose();
          part.section.geometry = geometry;
        }
        part.hasSection = Boolean(found);
      });
    }

    setBody(number, visible) {
      this.parts[number].visible = visible;
      this.show();
    }

    /* Drawing */

    show() {
      if (!this.field) return;
      const onContact = this.field.place === "pair";
      this.shared.enlargement.value = this.enlargement;
      [this.shared.least.value, this.shared.largest.value] = this.range;
      this.shared.colours.value = this.field.reversed ? this.tables.reversed : this.field.signed && this.range[0] < 0 ? this.tables.signed : this.tables.magnitude;
      this.shared.plain.value = onContact ? 1 : 0;
      this.shared.opacity.value = onContact ? 0.25 : 1;
      this.drawn.transparent = onContact;
      this.drawn.depthWrite = !onContact;
      for (const part of this.parts) {
        part.mesh.visible = part.edges.visible = part.visible;
        part.section.visible = part.visible && part.hasSection;
      }
      for (const part of this.faces) part.mesh.visible = onContact;
      this.label();
      this.request();
    }

    request() {
      if (this.waiting) return;
      this.waiting = true;
      requestAnimationFrame(() => this.draw());
    }

    draw() {
      this.waiting = false;
      this.render();
      this.triad();
    }

    render() {
      this.renderer.clear();
      this.renderer.render(this.scene, this.camera);
      this.renderer.clearDepth();
      this.renderer.render(this.front, this.camera);
    }

    resize() {
      const width = this.canvas.clientWidth || 600, height = this.canvas.clientHeight || 400, half = this.radius;
      this.renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
      this.renderer.setSize(width, height, false);
      const [wide, high] = width > height ? [half * width / height, half] : [half, half * height / width];
      const zoomed = this.fitted ? this.camera.zoom / this.fitted : 1; // by the user
      Object.assign(this.camera, { left: -wide, right: wide, top: high, bottom: -high });
      this.fit(zoomed);
      this.draw();
    }

    /* The coordinate axes in the corner. */
    triad() {
      const canvas = this.root.querySelector("canvas.triad"), pen = canvas.getContext("2d"), half = canvas.width / 2;
      pen.clearRect(0, 0, canvas.width, canvas.height);
      pen.font = "bold 15px sans-serif";
      pen.lineWidth = 2;
      const turn = this.camera.matrixWorldInverse.elements;
      ["#C1272D", "#00694D", "#0B4F9E"].forEach((colour, k) => {
        const x = turn[4 * k], y = turn[4 * k + 1];
        pen.strokeStyle = pen.fillStyle = colour;
        pen.beginPath();
        pen.moveTo(half, half);
        pen.lineTo(half + 0.6 * half * x, half - 0.6 * half * y);
        pen.stroke();
        pen.fillText("xyz"[k], half + 0.82 * half * x - 4, half - 0.82 * half * y + 5);
      });
    }

    /* Name and value under a point of the canvas, in its pixels; null beside the bodies. */
    pick(x, y) {
      const width = this.canvas.clientWidth, height = this.canvas.clientHeight, target = this.target || (this.target = new THREE.WebGLRenderTarget(1, 1));
      const onContact = this.field.place === "pair", objects = [], kept = [];
      for (const part of this.parts) {
        kept.push([part.mesh, part.mesh.material], [part.section, part.section.material], [part.edges, null]);
        [part.mesh.material, part.section.material] = part.picks;
        part.edges.visible = false;
        if (onContact) part.mesh.visible = false;
        objects.push(part);
      }
      for (const part of this.faces) {
        kept.push([part.mesh, part.mesh.material]);
        part.mesh.material = part.picks[0];
        objects.push(part);
      }
      const code = new Uint8Array(4);
      const pass = () => {
        this.camera.setViewOffset(width, height, x, y, 1, 1);
        this.renderer.setRenderTarget(target);
        this.render();
        this.renderer.readRenderTargetPixels(target, 0, 0, 1, 1, code);
        this.renderer.setRenderTarget(null);
        this.camera.clearViewOffset();
        return objects.find(part => part.number === 256 * code[0] + code[1]) || null;
      };
      let part = pass(), value = part ? 256 * code[2] + code[3] : MISSING;
      if (!part && onContact) {
        for (const body of this.parts) body.mesh.visible = body.visible;
        part = pass();
        value = MISSING;
      }
      for (const [object, material] of kept) if (material) object.material = material;
      for (const body of this.parts) body.mesh.visible = body.edges.visible = body.visible;
      if (!part) return null;
      const [least, largest] = this.range;
      return { name: part.name, value: value === MISSING ? null : least + value / 65534 * (largest - least) };
    }

    /* The page around the canvas */

    element(name) { return this.root.querySelector(`[data-part="${name}"]`); }

    label() {
      const { field, range, data } = this, legend = this.element("legend");
      const shown = value => shortNumber(field.factor * value);
      const stops = legend.querySelectorAll(".stop");
      stops.forEach((stop, k) => { stop.textContent = shown(range[0] + k / (stops.length - 1) * (range[1] - range[0])); });
      this.element("field").value = field.name;
      this.element("name").textContent = field.label + (field.shown ? ` [${field.shown}]` : "");
      if (data.frames.length > 1) {
        this.element("frame").value = this.frame;
        this.element("frame-name").textContent = data.frames[this.frame];
      }
      this.element("enlargement-name").textContent = this.enlargement === 0 ? "undeformed" : `\u00d7 ${shortNumber(this.enlargement)}`;
      this.element("cut-name").textContent = this.cut ? `${"xyz"[this.cut.axis]} = ${shortNumber(this.cut.level)} ${data.length}` : "";
      for (const [name, value] of [["least", range[0]], ["largest", range[1]]]) {
        const input = this.element(name);
        if (document.activeElement !== input) input.value = Number((field.factor * value).toPrecision(5));
      }
      const bar = legend.querySelector("canvas"), pen = bar.getContext("2d"), table = this.shared.colours.value.image.data;
      for (let i = 0; i < bar.width; ++i) {
        const c = 4 * Math.round(255 * i / (bar.width - 1));
        pen.fillStyle = `rgb(${table[c]}, ${table[c + 1]}, ${table[c + 2]})`;
        pen.fillRect(i, 0, 1, bar.height);
      }
    }

    controls() {
      const on = (name, event, does) => this.element(name).addEventListener(event, does);
      const cut = () => this.setCut(Number(this.element("axis").value), Number(this.element("level").value), this.element("other").checked);
      on("field", "change", event => this.setField(event.target.value));
      on("enlargement", "input", event => this.setEnlargement(Number(event.target.value) * this.data.enlargement));
      on("true-scale", "click", () => { this.setEnlargement(1); this.element("enlargement").value = 1 / this.data.enlargement; });
      for (const name of ["axis", "level", "other"]) on(name, name === "level" ? "input" : "change", cut);
      for (const name of ["least", "largest"])
        on(name, "change", () => this.setRange(this.element("least").value / this.field.factor, this.element("largest").value / this.field.factor));
      on("whole-range", "click", () => this.setField(this.field.name));
      on("reset", "click", () => this.lookFrom(1, -1.4, 0.9));
      for (const [name, ...direction] of [["from-x", 1, 0, 0], ["from-y", 0, -1, 0], ["from-z", 0, -1e-6, 1]]) on(name, "click", () => this.lookFrom(...direction));
      if (this.data.frames.length > 1) {
        on("frame", "input", event => this.setFrame(Number(event.target.value)));
        on("play", "click", () => this.play());
      }
      this.root.querySelectorAll("input[data-body]").forEach(box => box.addEventListener("change", () => this.setBody(Number(box.dataset.body), box.checked)));
      this.canvas.addEventListener("mousemove", event => { if (!event.buttons) this.hover(event); });
      this.canvas.addEventListener("mouseleave", () => { this.element("hover").textContent = ""; });
      // A tap, since touching has no pointer.
      this.canvas.addEventListener("touchstart", event => { this.touched = event.touches[0]; });
      this.canvas.addEventListener("touchend", event => {
        const end = event.changedTouches[0], start = this.touched;
        if (start && Math.hypot(end.clientX - start.clientX, end.clientY - start.clientY) < 8) this.hover(end);
      });
      if (window.ResizeObserver) new ResizeObserver(() => this.resize()).observe(this.canvas);
      else window.addEventListener("resize", () => this.resize());
    }

    hover(event) {
      const place = this.canvas.getBoundingClientRect(), found = this.pick(event.clientX - place.left, event.clientY - place.top);
      const value = found && found.value !== null ? `: ${shortNumber(this.field.factor * found.value)} ${this.field.shown}` : "";
      this.element("hover").textContent = found ? found.name + value : "";
    }

    /* Runs through the load steps, again and again. */
    play() {
      const button = this.element("play"), count = this.data.frames.length;
      if (this.playing) {
        clearInterval(this.playing);
        this.playing = null;
      } else
        this.playing = setInterval(() => this.setFrame((this.frame + 1) % count), Math.max(120, Math.min(700, 6000 / count)));
      button.textContent = this.playing ? "\u25a0 stop" : "\u25b6 play";
    }
  }

  const root = document.getElementById("view3d");
  root.classList.add("ready"); // first, since a hidden canvas has no size
  try {
    window.sutureView = new View(root, JSON.parse(document.getElementById("view3d_data").textContent));
  } catch (problem) {
    root.classList.remove("ready");
    root.querySelector(".failed").textContent = `This browser does not draw in 3D (${problem.message}). The pictures below show the same fields.`;
    root.classList.add("broken");
  }
})();
