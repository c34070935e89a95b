// The cells in motion: surfaces drawn by a small software rasteriser with a depth buffer, so that the page needs neither
// a library nor a graphics card. One Viewer for each <figure class="viewer">.
(() => {
  "use strict";

  const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer;
  const light = [-0.36, 0.58, 0.73]; // from the upper left, in front
  const markAngle = 0.3; // radius of the marked patch as part of the cell's largest radius

  /** Normals of all vertices, of length one: sums over the triangles around them. */
  function vertexNormals(x, triangles) {
    const n = new Float32Array(x.length);
    for (let t = 0; t < triangles.length; t += 3) {
      const a = 3 * triangles[t], b = 3 * triangles[t + 1], c = 3 * triangles[t + 2];
      const ux = x[b] - x[a], uy = x[b + 1] - x[a + 1], uz = x[b + 2] - x[a + 2];
      const vx = x[c] - x[a], vy = x[c + 1] - x[a + 1], vz = x[c + 2] - x[a + 2];
      const nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
      for (const i of [a, b, c]) {
        n[i] += nx;
        n[i + 1] += ny;
        n[i + 2] += nz;
      }
    }
    for (let i = 0; i < n.length; i += 3) {
      const length = Math.hypot(n[i], n[i + 1], n[i + 2]) || 1;
      n[i] /= length;
      n[i + 1] /= length;
      n[i + 2] /= length;
    }
    return n;
  }

  /** How dark each vertex is marked, 0 to 1: a patch around the vertex of each cell that is farthest in x at first. */
  function marks(x, starts) {
    const mark = new Float32Array(x.length / 3);
    starts.forEach((first, k) => {
      const end = k + 1 < starts.length ? starts[k + 1] : mark.length;
      let far = first, low = Infinity;
      for (let i = first; i < end; ++i) {
        if (x[3 * i] > x[3 * far]) far = i;
        low = Math.min(low, x[3 * i]);
      }
      const radius = (markAngle * (x[3 * far] - low)) / 2;
      for (let i = first; i < end; ++i) {
        const d = Math.hypot(x[3 * i] - x[3 * far], x[3 * i + 1] - x[3 * far + 1], x[3 * i + 2] - x[3 * far + 2]);
        mark[i] = Math.max(0, Math.min(1, 2 * (1 - d / radius)));
      }
    });
    return mark;
  }

  class Viewer {
    constructor(figure) {
      this.figure = figure;
      this.data = JSON.parse(figure.querySelector("script").textContent);
      this.meshes = this.data.meshes.map((m) => ({
        triangles: m.wide ? new Uint32Array(bytes(m.triangles)) : new Uint16Array(bytes(m.triangles)),
        starts: m.starts,
      }));
      this.frames = this.data.frames.map((text) => Float32Array.from(new Int16Array(bytes(text)), (q) => q * this.data.step));
      this.meshes.forEach((mesh, k) => {
        const first = this.frames[this.data.mesh.indexOf(k)];
        mesh.mark = this.data.mark ? marks(first, mesh.starts) : new Float32Array(first.length / 3);
        mesh.cell = new Uint16Array(first.length / 3);
        mesh.starts.forEach((start, c) => mesh.cell.fill(c, start));
      });
      this.canvas = figure.querySelector("canvas");
      this.context = this.canvas.getContext("2d");
      this.slider = figure.querySelector("input");
      this.output = figure.querySelector("output");
      this.button = figure.querySelector("button");
      this.yaw = -0.5;
      this.pitch = 0.3;
      this.zoom = 1;
      this.timer = 0;
      this.extent = this.viewExtent();
      this.listen();
      this.draw();
    }

    /** Half the width and height of all frames as seen at first. */
    viewExtent() {
      const r = this.rotation();
      let wide = 1e-9, high = 1e-9;
      for (const x of this.frames)
        for (let i = 0; i < x.length; i += 3) {
          wide = Math.max(wide, Math.abs(r[0] * x[i] + r[1] * x[i + 1] + r[2] * x[i + 2]));
          high = Math.max(high, Math.abs(r[3] * x[i] + r[4] * x[i + 1] + r[5] * x[i + 2]));
        }
      return [wide, high];
    }

    rotation() {
      const cy = Math.cos(this.yaw), sy = Math.sin(this.yaw), cp = Math.cos(this.pitch), sp = Math.sin(this.pitch);
      return [cy, 0, sy, sp * sy, cp, -sp * cy, -cp * sy, sp, cp * cy];
    }

    listen() {
      this.slider.addEventListener("input", () => {
        this.pause();
        this.draw();
      });
      this.button.addEventListener("click", () => (this.timer ? this.pause() : this.play()));
      let from = null;
      this.canvas.addEventListener("pointerdown", (e) => {
        from = [e.clientX, e.clientY];
        this.canvas.setPointerCapture(e.pointerId);
      });
      this.canvas.addEventListener("pointermove", (e) => {
        if (!from) return;
        this.turn((e.clientX - from[0]) * 0.01, (e.clientY - from[1]) * 0.01);
        from = [e.clientX, e.clientY];
      });
      for (const end of ["pointerup", "pointercancel"]) this.canvas.addEventListener(end, () => (from = null));
      this.canvas.addEventListener("keydown", (e) => {
        const turns = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1] };
        if (turns[e.key]) this.turn(...turns[e.key]);
        else if (e.key === "+" || e.key === "-") {
          this.zoom *= e.key === "+" ? 1.1 : 1 / 1.1;
          this.draw();
        } else return;
        e.preventDefault();
      });
      new ResizeObserver(() => this.draw()).observe(this.canvas);
      for (const query of ["(prefers-color-scheme: dark)", "print"])
        matchMedia(query).addEventListener("change", () => this.draw());
    }

    turn(yaw, pitch) {
      this.yaw += yaw;
      this.pitch = Math.max(-1.57, Math.min(1.57, this.pitch + pitch));
      this.draw();
    }

    play() {
      const delay = Math.max(50, Math.min(400, 6000 / this.frames.length));
      this.figure.classList.add("playing");
      this.button.setAttribute("aria-label", "Pause");
      this.timer = setInterval(() => {
        this.slider.value = (Number(this.slider.value) + 1) % this.frames.length;
        this.draw();
      }, delay);
    }

    pause() {
      clearInterval(this.timer);
      this.timer = 0;
      this.figure.classList.remove("playing");
      this.button.setAttribute("aria-label", "Play");
    }

    draw() {
      const frame = Number(this.slider.value), { label, unit, at } = this.data;
      const value = Number(at[frame].toPrecision(4));
      this.output.textContent = `${label} ${value}${unit ? " " + unit : ""}`;
      this.slider.setAttribute("aria-valuetext", this.output.textContent);
      // twice the resolution of the screen smooths the edges
      const ratio = Math.max(2, window.devicePixelRatio || 1);
      const width = Math.max(1, Math.round(this.canvas.clientWidth * ratio));
      const height = Math.max(1, Math.round(this.canvas.clientHeight * ratio));
      if (this.canvas.width !== width || this.canvas.height !== height) {
        this.canvas.width = width;
        this.canvas.height = height;
        this.image = this.context.createImageData(width, height);
        this.pixels = new Uint32Array(this.image.data.buffer);
        this.depth = new Float32Array(width * height);
      }
      this.scale = 0.82 * this.zoom * Math.min(width / (2 * this.extent[0]), height / (2 * this.extent[1]));
      this.pixels.fill(0);
      this.depth.fill(-Infinity);
      this.surface(this.frames[frame], this.meshes[this.data.mesh[frame]], width, height);
      this.context.putImageData(this.image, 0, 0);
      this.scaleBar(width, height, ratio);
      this.axes(height, ratio);
    }

    /** Projects and shades the vertices, then fills the triangles. */
    surface(x, mesh, width, height) {
      const r = this.rotation(), count = x.length / 3, normals = vertexNormals(x, mesh.triangles);
      const px = new Float32Array(count), py = new Float32Array(count), pz = new Float32Array(count);
      const shade = new Float32Array(3 * count);
      const base = (getComputedStyle(this.canvas).color.match(/[\d.]+/g) || [190, 60, 50]).map(Number);
      for (let i = 0; i < count; ++i) {
        const a = x[3 * i], b = x[3 * i + 1], c = x[3 * i + 2];
        px[i] = width / 2 + this.scale * (r[0] * a + r[1] * b + r[2] * c);
        py[i] = height / 2 - this.scale * (r[3] * a + r[4] * b + r[5] * c);
        pz[i] = r[6] * a + r[7] * b + r[8] * c;
        const u = normals[3 * i], v = normals[3 * i + 1], w = normals[3 * i + 2];
        const nx = r[0] * u + r[1] * v + r[2] * w, ny = r[3] * u + r[4] * v + r[5] * w, nz = r[6] * u + r[7] * v + r[8] * w;
        const facing = nx * light[0] + ny * light[1] + nz * light[2];
        const gloss = Math.pow(Math.max(0, 2 * facing * nz - light[2]), 18) * 60;
        const tone = [1, 0.82, 1.12, 0.92, 1.06, 0.74][mesh.cell[i] % 6]; // tells neighbours apart
        const bright = (0.42 + 0.66 * Math.max(0, facing)) * tone * (1 - 0.72 * mesh.mark[i]);
        for (let k = 0; k < 3; ++k) shade[3 * i + k] = Math.min(255, base[k] * bright + gloss);
      }
      for (let t = 0; t < mesh.triangles.length; t += 3)
        this.fill(mesh.triangles[t], mesh.triangles[t + 1], mesh.triangles[t + 2], px, py, pz, shade, width, height);
    }

    /** One triangle with interpolated depth and colour. */
    fill(i, j, k, px, py, pz, shade, width, height) {
      const x0 = px[i], y0 = py[i], x1 = px[j], y1 = py[j], x2 = px[k], y2 = py[k];
      const area = (x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0);
      if (Math.abs(area) < 1e-6) return;
      const left = Math.max(0, Math.floor(Math.min(x0, x1, x2))), right = Math.min(width - 1, Math.ceil(Math.max(x0, x1, x2)));
      const top = Math.max(0, Math.floor(Math.min(y0, y1, y2))), bottom = Math.min(height - 1, Math.ceil(Math.max(y0, y1, y2)));
      const c = shade, i3 = 3 * i, j3 = 3 * j, k3 = 3 * k;
      for (let y = top; y <= bottom; ++y)
        for (let x = left; x <= right; ++x) {
          const b = ((x - x0) * (y2 - y0) - (x2 - x0) * (y - y0)) / area;
          const g = ((x1 - x0) * (y - y0) - (x - x0) * (y1 - y0)) / area;
          const a = 1 - b - g;
          if (a < 0 || b < 0 || g < 0) continue;
          const at = y * width + x, z = a * pz[i] + b * pz[j] + g * pz[k];
          if (z <= this.depth[at]) continue;
          this.depth[at] = z;
          const red = a * c[i3] + b * c[j3] + g * c[k3];
          const green = a * c[i3 + 1] + b * c[j3 + 1] + g * c[k3 + 1];
          const blue = a * c[i3 + 2] + b * c[j3 + 2] + g * c[k3 + 2];
          this.pixels[at] = 0xff000000 | (blue << 16) | (green << 8) | red;
        }
    }

    pen(ratio) {
      const style = getComputedStyle(this.figure);
      this.context.strokeStyle = this.context.fillStyle = style.color;
      this.context.lineWidth = 1.25 * ratio;
      this.context.font = `${12 * ratio}px ${style.fontFamily}`;
      return this.context;
    }

    /** A bar of 1, 2 or 5 times a power of ten micrometres. */
    scaleBar(width, height, ratio) {
      const room = (0.22 * width) / this.scale, decade = Math.pow(10, Math.floor(Math.log10(room)));
      const length = [5, 2, 1].map((m) => m * decade).find((l) => l <= room);
      const pen = this.pen(ratio), right = width - 14 * ratio, y = height - 14 * ratio;
      pen.beginPath();
      pen.moveTo(right - length * this.scale, y);
      pen.lineTo(right, y);
      pen.stroke();
      pen.textAlign = "right";
      pen.fillText(`${Number(length.toPrecision(2))} \u00b5m`, right, y - 6 * ratio);
    }

    /** The directions of x, y and z in the lower left corner. */
    axes(height, ratio) {
      const pen = this.pen(ratio), r = this.rotation(), length = 20 * ratio, x = 34 * ratio, y = height - 34 * ratio;
      pen.textAlign = "center";
      ["x", "y", "z"].forEach((name, q) => {
        const dx = r[q] * length, dy = -r[3 + q] * length;
        pen.beginPath();
        pen.moveTo(x, y);
        pen.lineTo(x + dx, y + dy);
        pen.stroke();
        if (Math.hypot(dx, dy) > 5 * ratio) pen.fillText(name, x + 1.4 * dx, y + 1.4 * dy + 4 * ratio);
      });
    }
  }

  document.querySelectorAll(".viewer").forEach((figure) => new Viewer(figure));
  // what is folded away is printed all the same
  addEventListener("beforeprint", () => document.querySelectorAll("details").forEach((d) => (d.open = true)));
})();
