// Draws the bearing seen from +X and the cage unrolled; displacements and clearances are magnified `scale` times about the undisturbed positions, so
// gaps close on the screen when they close in the bearing.
//
//   Z, scale, bearing   number of balls, magnification, dimensions by their parameter names [m]
//   bend                magnification of what elastic halves move by their modes, 0 or left out for rigid ones
//   range               largest race load, pocket force and stress and the least stress, to which arrows and colours belong: {race, pocket, stress, least}
//   land                whether the outer ring guides the cage by a land, which is drawn; left out: true
//   has(name)           whether a channel is known
//
// What is drawn comes from a reader `see` of one instant, with the channels' names of animation.py: see.angle(name), see.value(name), see.peak(name),
// and see.gone(k), whether rivet k is broken, where there is one.
"use strict";
function bearingDrawing({ Z, scale, bend, bearing, range, has, land = true }) {
  const colours = {};
  const mm = (name) => 1e3 * bearing[name];
  const R = mm("bearing.D") / 2, pitch = mm("bearing.d_m") / 2;
  const pocket = R + scale * mm("cage.pocket_clearance") / 2, guide = scale * mm("cage.guide_clearance") / 2;
  const outerRace = pitch + R + scale * mm("bearing.P_d") / 4, innerRace = pitch - R - scale * mm("bearing.P_d") / 4;
  const cageOut = mm("cage.D_o") / 2, cageIn = mm("cage.D_i") / 2, rivet = 0.075 * mm("bearing.D") + 0.2;
  function readColours() {
    const style = getComputedStyle(document.documentElement);
    for (const name of ["ink", "muted", "line", "paper", "ring", "ball", "cage", "cage-back", "head", "middle", "force", "amber"]) colours[name] = style.getPropertyValue("--" + name).trim();
  }
  function prepare(canvas) {
    const finer = document.documentElement.dataset.theme ? 3 : 1;  // on paper
    const width = canvas.clientWidth, height = canvas.clientHeight, ratio = finer * (window.devicePixelRatio || 1);
    if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(height * ratio);
    }
    const g = canvas.getContext("2d");
    g.setTransform(ratio, 0, 0, ratio, 0, 0);
    g.clearRect(0, 0, width, height);
    g.lineJoin = g.lineCap = "round";
    g.font = "12px system-ui, sans-serif";
    return { g, width, height };
  }
  // Viridis over the range of head stress in this run.
  const viridis = [[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 37]];
  function heat(stress) {
    const x = range.stress > range.least ? 4 * Math.min(1, Math.max(0, (stress - range.least) / (range.stress - range.least))) : 0, i = Math.min(3, Math.floor(x));
    return `rgb(${viridis[i].map((c, n) => Math.round(c + (x - i) * (viridis[i + 1][n] - c))).join(" ")})`;
  }
  function arrow(g, x0, y0, x1, y1, colour, width) {
    const length = Math.hypot(x1 - x0, y1 - y0);
    if (length < 1e-3) return;
    const ux = (x1 - x0) / length, uy = (y1 - y0) / length, tip = Math.min(2.2 * width + 0.4, 0.6 * length);
    g.strokeStyle = g.fillStyle = colour;
    g.lineWidth = width;
    g.beginPath();
    g.moveTo(x0, y0);
    g.lineTo(x1 - ux * tip, y1 - uy * tip);
    g.stroke();
    g.beginPath();
    g.moveTo(x1, y1);
    g.lineTo(x1 - ux * tip - uy * tip * 0.55, y1 - uy * tip + ux * tip * 0.55);
    g.lineTo(x1 - ux * tip + uy * tip * 0.55, y1 - uy * tip - ux * tip * 0.55);
    g.fill();
  }
  function ringShape(g, x, y, inner, outer, fill) {
    g.beginPath();
    g.arc(x, y, outer, 0, 2 * Math.PI);
    g.arc(x, y, inner, 0, 2 * Math.PI, true);
    g.fillStyle = fill;
    g.fill();
    g.stroke();
  }

  // Motions (along X, outward, turning) [mm] of half h as drawn at the angle a of the cage, in which pocket 1 is at 0: those at the rivets, joined by the
  // waves of the fewest lobes that go through all of them.
  function bending(see) {
    if (!bend) return () => [0, 0, 0];
    const at = [0, 1].map((h) => Array.from({ length: Z }, (_, k) => ["x", "r", "t"].map((name) => 1e3 * bend * see.value(`${k + 1}_flex_${h}_${name}`))));
    return (h, a) => {
      const sum = [0, 0, 0];
      for (let k = 0; k < Z; k++) {
        const d = a / 2 - (Math.PI * (k + 0.5)) / Z, under = Z % 2 ? Math.sin(d) : Math.tan(d);
        const weight = Math.abs(Math.sin(d)) < 1e-9 ? 1 : Math.sin(Z * d) / (Z * under);
        for (let c = 0; c < 3; c++) sum[c] += weight * at[h][k][c];
      }
      return sum;
    };
  }

  // Seen along -X: Y to the right, Z up.
  function drawFront(canvas, see, follow) {
    const { g, width, height } = prepare(canvas);
    const rim = outerRace + 0.3 * R, bar = 1.7 * R, reach = rim + bar + 1;
    const zoom = Math.min(width, height) / (2 * reach);
    const psi = see.angle("psi"), view = follow ? -psi : 0;
    g.save();
    g.translate(width / 2, height / 2);
    g.scale(zoom, -zoom);
    g.save();
    g.rotate(view);
    g.strokeStyle = colours.ink;
    g.lineWidth = 0.8 / zoom;
    ringShape(g, 0, 0, outerRace, rim, colours.ring);
    const ry = 1e3 * scale * see.value("ring.y"), rz = 1e3 * scale * see.value("ring.z"), bore = innerRace - 0.45 * R;
    ringShape(g, ry, rz, bore, innerRace, colours.ring);
    const mark = see.angle("shaft");
    g.beginPath();
    g.moveTo(ry + bore * Math.cos(mark), rz + bore * Math.sin(mark));
    g.lineTo(ry + (bore + 0.3 * R) * Math.cos(mark), rz + (bore + 0.3 * R) * Math.sin(mark));
    g.lineWidth = 2.5 / zoom;
    g.stroke();
    g.lineWidth = 0.8 / zoom;
    if (land) {
      g.setLineDash([3 / zoom, 3 / zoom]);
      g.strokeStyle = colours.muted;
      g.beginPath();
      g.arc(0, 0, cageOut + guide, 0, 2 * Math.PI);
      g.stroke();
      g.setLineDash([]);
    }

    const flex = bending(see);
    const bodies = [0, 1].map((h) => [...["y", "z"].map((name) => 1e3 * scale * see.value(`half_${h}.${name}`)), psi + (h ? 0.5 : -0.5) * scale * see.value("twist")]);
    const at = (h, r, a) => {  // a place of half h, at the azimuth a without its bending
      const [cy, cz, turn] = bodies[h], [, u, v] = flex(h, a - turn);
      return [cy + (r + u) * Math.cos(a + v / r), cz + (r + u) * Math.sin(a + v / r)];
    };
    const webs = (h, fill) => {
      const [cy, cz, turn] = bodies[h];
      const edge = (r, from, to) => {
        if (!bend) g.arc(cy, cz, r, from, to, to < from);
        else for (let i = 0; i <= 8; i++) g.lineTo(...at(h, r, from + ((to - from) * i) / 8));
      };
      const wall = (r) => Math.asin(Math.min(0.95, pocket / r));
      for (let k = 0; k < Z; k++) {
        const a = turn + (2 * Math.PI * k) / Z, b = turn + (2 * Math.PI * (k + 1)) / Z, c = (a + b) / 2;
        const out = Math.min(wall(cageOut), (b - a) / 2), inn = Math.min(wall(cageIn), (b - a) / 2);
        g.beginPath();
        edge(cageOut, a + out, b - out);
        edge(cageIn, b - inn, a + inn);
        g.closePath();
        g.fillStyle = fill;
        g.fill();
        g.strokeStyle = colours.ink;
        g.stroke();
        if (h === 1 && !(see.gone && see.gone(k + 1))) {
          g.beginPath();
          g.arc(...at(h, pitch, c), rivet, 0, 2 * Math.PI);
          g.fillStyle = has("stress" + (k + 1)) ? heat(see.peak("stress" + (k + 1))) : colours.muted;
          g.fill();
          g.stroke();
        }
      }
    };
    const caps = () => {  // the sheet of half 1 over the balls, between its lands, so thin that the balls show
      const turn = bodies[1][2], step = (2 * Math.PI) / Z;
      g.lineWidth = 0.8 / zoom;
      for (let k = 0; k < Z; k++) {
        const wide = Math.min(step / 2, Math.asin(Math.min(0.95, pocket / cageOut))), a = turn + step * k;
        const points = (r, sign) => Array.from({ length: 13 }, (_, i) => at(1, r, a + sign * wide * (i / 6 - 1)));
        g.beginPath();
        for (const point of [...points(cageOut, 1), ...points(cageIn, -1)]) g.lineTo(...point);
        g.closePath();
        g.globalAlpha = 0.45;
        g.fillStyle = colours.cage;
        g.fill();
        g.globalAlpha = 1;
        g.strokeStyle = colours.ink;
        g.stroke();
      }
    };
    webs(0, colours["cage-back"]);
    webs(1, colours.cage);

    for (let j = 1; j <= Z; j++) {
      const lag = see.value("lag" + j), azimuth = psi + (2 * Math.PI * (j - 1)) / Z + scale * lag;
      const r = pitch + scale * (1e3 * see.value("r" + j) - pitch), c = Math.cos(azimuth), s = Math.sin(azimuth);
      g.beginPath();
      g.arc(r * c, r * s, R, 0, 2 * Math.PI);
      g.fillStyle = colours.ball;
      g.fill();
      g.strokeStyle = colours.ink;
      g.lineWidth = 0.8 / zoom;
      g.stroke();
      if (j === 1) {
        g.beginPath();
        g.arc(r * c, r * s, 0.12 * R, 0, 2 * Math.PI);
        g.fillStyle = colours.ink;
        g.fill();
      }
      if (range.race > 0) {
        const [outside, inside] = ["Q_e", "Q_i"].map((name) => bar * Math.min(1, see.value(name + j) / range.race));
        arrow(g, (rim + 0.4) * c, (rim + 0.4) * s, (rim + 0.4 + outside) * c, (rim + 0.4 + outside) * s, colours.force, 0.7);
        arrow(g, ry + (bore - 0.4) * c, rz + (bore - 0.4) * s, ry + (bore - 0.4 - inside) * c, rz + (bore - 0.4 - inside) * s, colours.middle, 0.7);
      }
    }
    if (bearing["cage.sheet"] > 0) caps();
    for (let j = 1; j <= Z; j++) {
      const azimuth = psi + (2 * Math.PI * (j - 1)) / Z + scale * see.value("lag" + j), c = Math.cos(azimuth), s = Math.sin(azimuth);
      const r = pitch + scale * (1e3 * see.value("r" + j) - pitch), push = see.value("Q_c" + j);
      if (push > 0.01 * range.pocket) {
        const side = gapSide(see, j) * R * (0.5 + 1.4 * Math.min(1, push / range.pocket));
        arrow(g, r * c, r * s, r * c - s * side, r * s + c * side, colours.head, 0.9);
      }
    }
    if (bend) {
      g.lineWidth = 0.8 / zoom;
      g.strokeStyle = colours.muted;
      g.setLineDash([1 / zoom, 3 / zoom]);
      g.beginPath();
      g.arc(bodies[1][0], bodies[1][1], pitch, 0, 2 * Math.PI);
      g.stroke();
      g.setLineDash([]);
      for (const [h, colour] of [[0, colours.muted], [1, colours.amber]]) {
        g.beginPath();
        for (let i = 0; i < 12 * Z; i++) g.lineTo(...at(h, pitch, bodies[h][2] + (2 * Math.PI * i) / (12 * Z)));
        g.closePath();
        g.lineWidth = 1.5 / zoom;
        g.strokeStyle = colour;
        g.stroke();
      }
    }
    const F_y = see.value("shaft.F_y"), F_z = see.value("shaft.F_z"), F = Math.hypot(F_y, F_z);
    if (F > 0) arrow(g, ry, rz, ry + (0.6 * R * F_y) / F, rz + (0.6 * R * F_z) / F, colours.ink, 1);
    g.restore();
    g.restore();
    g.fillStyle = colours.muted;
    g.textAlign = "left";
    g.fillText(follow ? "turning with the cage" : "Y to the right, Z up", 4, height - 6);
  }
  // +1 where the ball presses on the wall ahead of it, -1 on the one behind.
  function gapSide(see, j) {
    const a = (2 * Math.PI * (j - 1)) / Z + see.angle("psi");
    const across = (h) => Math.cos(a) * see.value(`half_${h}.z`) - Math.sin(a) * see.value(`half_${h}.y`);
    return see.value("r" + j) * see.value("lag" + j) - 0.5 * (across(0) + across(1)) >= 0 ? 1 : -1;
  }

  // Height of a ribbon's sheet over the split at the distance from a pocket's axis and z from the balls' side: sphere, fillet, land.
  function sheet(from, z) {
    const f = mm("cage.pocket_fillet"), Rc = pocket, e = scale * (R + mm("cage.pocket_clearance") / 2 - mm("cage.pocket_depth"));
    const seam = Math.asin((f + e) / (Rc + f)), circle = (Rc + f) * Math.cos(seam);
    if (from < (Rc + z) * Math.cos(seam)) return Math.sqrt((Rc + z) ** 2 - from * from) - e;
    return from < circle ? f - Math.sqrt((f - z) ** 2 - (circle - from) ** 2) : z;
  }

  // The cage unrolled at the pitch circle: azimuth in the cage to the right, X up.
  function drawStrip(canvas, see) {
    const { g, width, height } = prepare(canvas);
    const length = 2 * Math.PI * pitch, zoom = Math.min(width / (length * 1.02), height / (2.6 * pocket + 8));
    const psi = see.angle("psi"), step = length / Z, half = mm("cage.width") / 2, ribbon = bearing["cage.sheet"] > 0;
    const wall = Math.max(0.8, half - R), flange = ribbon ? mm("cage.sheet") : 0.14 * mm("bearing.D");
    g.save();
    g.translate(width / 2 - (zoom * length) / 2, height / 2);
    g.scale(zoom, -zoom);
    g.lineWidth = 0.8 / zoom;
    g.strokeStyle = colours.ink;
    const flex = bending(see);
    const shift = (h, s) => {  // displacement of the half at the place s along the strip, magnified [mm]
      const own = (s / pitch) - Math.PI / Z, [u, , v] = flex(h, own);
      const a = own + psi, r = pitch * 1e-3, c = Math.cos(a), n = Math.sin(a);
      const twist = (h ? 0.5 : -0.5) * see.value("twist");
      return [
        1e3 * scale * (c * see.value(`half_${h}.z`) - n * see.value(`half_${h}.y`) + r * twist) + v,
        1e3 * scale * (see.value(`half_${h}.x`) - see.value(`half_${h}.tilt_z`) * r * c + see.value(`half_${h}.tilt_y`) * r * n) + u,
      ];
    };
    for (const h of [0, 1]) {
      const side = h ? 1 : -1, inner = [], outer = [];
      for (let i = 0; i <= 24 * Z; i++) {
        const s = (i / (24 * Z)) * length, local = Math.abs(((s + step) % step) - step / 2), [ds, dx] = shift(h, s);
        inner.push([s + ds, dx + side * (ribbon ? sheet(local, 0) : Math.sqrt(Math.max(pocket * pocket - local * local, 0)))]);
        outer.push([s + ds, dx + side * (ribbon ? sheet(local, flange) : Math.max(Math.sqrt(Math.max((pocket + wall) ** 2 - local * local, 0)), flange))]);
      }
      g.beginPath();
      [...inner, ...outer.reverse()].forEach(([s, x], i) => (i ? g.lineTo(s, x) : g.moveTo(s, x)));
      g.closePath();
      g.fillStyle = h ? colours.cage : colours["cage-back"];
      g.fill();
      g.stroke();
    }
    for (let k = 1; k <= Z; k++) {
      if (see.gone && see.gone(k)) continue;
      const s = k === Z ? length : k * step, place = shift(1, s), other = shift(0, s);
      for (const at of k === Z ? [0, length] : [s]) {
        const x = at + 0.5 * (place[0] + other[0]);
        g.beginPath();
        g.rect(x - rivet * 0.6, other[1] - flange, 1.2 * rivet, place[1] - other[1] + 2 * flange);
        for (const [middle, sign] of [[place[1] + flange, 1], [other[1] - flange, -1]]) g.rect(x - rivet * 1.2, sign > 0 ? middle : middle - 0.09 * 2 * R, 2.4 * rivet, 0.09 * 2 * R);
        g.fillStyle = has("stress" + k) ? heat(see.peak("stress" + k)) : colours.muted;
        g.fill();
        g.stroke();
      }
    }
    g.textAlign = "center";
    for (let j = 1; j <= Z; j++) {
      const s = (j - 0.5) * step + 1e3 * scale * see.value("r" + j) * see.value("lag" + j), x = 1e3 * scale * see.value("x" + j);
      g.beginPath();
      g.arc(s, x, R, 0, 2 * Math.PI);
      g.fillStyle = colours.ball;
      g.fill();
      g.strokeStyle = colours.ink;
      g.lineWidth = 0.8 / zoom;
      g.stroke();
      g.save();
      g.translate(s, x);
      g.scale(1 / zoom, -1 / zoom);
      g.fillStyle = colours.ink;
      g.fillText(String(j), 0, 4);
      g.restore();
      const push = see.value("Q_c" + j);
      if (push > 0.01 * range.pocket) arrow(g, s, x + 0.65 * R, s + gapSide(see, j) * R * (0.4 + 1.2 * Math.min(1, push / range.pocket)), x + 0.65 * R, colours.head, 0.9);
    }
    g.restore();
  }

  return { colours, readColours, prepare, bending, drawFront, drawStrip };
}
