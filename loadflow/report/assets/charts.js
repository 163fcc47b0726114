"use strict";
(() => {
  // --- numbers of a chart, as loadflow.report.charts packs them ---
  const MISSING = 65535;
  function unpack(told) {
    if (Array.isArray(told)) return told;
    if ("step" in told) return Float64Array.from({ length: told.count }, (_, i) => told.start + i * told.step);
    const bytes = Uint8Array.from(atob(told.data), c => c.charCodeAt(0));
    const codes = new Uint16Array(bytes.buffer), scale = (told.high - told.low) / (MISSING - 1);
    return Array.from(codes, c => (c === MISSING ? null : told.low + c * scale));
  }

  const COLOURS = ["#1f5a94", "#d1612b", "#3d8b5f", "#8a4f9e", "#b08d1e", "#4b9fb5", "#666666"];
  const drawn = new Map(); // element → its plots
  const rounded = v => (v == null ? "–" : Number(v.toPrecision(5)).toString());
  const RAISED = { "-": "⁻", 0: "⁰", 1: "¹", 2: "²", 3: "³", 4: "⁴", 5: "⁵", 6: "⁶", 7: "⁷", 8: "⁸", 9: "⁹" };
  const power = v => (v > 0 ? Math.round(Math.log10(v)) : NaN);
  const whole = v => v != null && Math.abs(v / 10 ** power(v) - 1) < 1e-6;
  const sparse = ticks => ticks.filter(whole).length < 2; // few powers of ten: all ticks count
  const ruled = (_, ticks) => (sparse(ticks) ? ticks : ticks.map(v => (whole(v) ? v : null)));
  function decades(ticks) { // powers of ten are written; all ticks where there are few of these
    const few = sparse(ticks);
    const said = k => (k >= -2 && k <= 3 ? rounded(10 ** k) : "10" + [...String(k)].map(c => RAISED[c]).join(""));
    return ticks.map(v => (v == null ? "" : whole(v) ? said(power(v)) : few ? rounded(v) : ""));
  }
  uPlot.pxRatio = Math.max(2, devicePixelRatio); // sharp on paper

  function width(box, count) { return Math.max(240, Math.floor((box.clientWidth - 4) / count)); }
  function columns(box, data) { return data.points ? Math.max(1, Math.min(data.panels.length, Math.floor(box.clientWidth / 270))) : 1; }

  function level(value) { // dashed line across
    return plot => {
      const y = plot.valToPos(value, "y", true), { left, width } = plot.bbox, c = plot.ctx;
      c.save(); c.setLineDash([8, 6]); c.strokeStyle = "#000"; c.lineWidth = 2;
      c.beginPath(); c.moveTo(left, y); c.lineTo(left + width, y); c.stroke(); c.restore();
    };
  }

  function mark(place) { // dashed line from top to bottom
    return plot => {
      const x = plot.valToPos(place, "x", true), { left, width, top, height } = plot.bbox, c = plot.ctx;
      if (x < left || x > left + width) return;
      c.save(); c.setLineDash([8, 6]); c.strokeStyle = "#d1612b"; c.lineWidth = 2;
      c.beginPath(); c.moveTo(x, top); c.lineTo(x, top + height); c.stroke(); c.restore();
    };
  }

  function options(box, data, panel, k) {
    const last = data.points || k === data.panels.length - 1, many = columns(box, data);
    const wide = data.points;
    const series = panel.lines.map((line, i) => ({
      label: line.name || "value", stroke: COLOURS[i % COLOURS.length], width: 1, spanGaps: false,
      value: (_, v) => rounded(v),
      ...(data.points || panel.dots ? { paths: () => null, points: { show: true, size: data.points ? 5 : 4, fill: COLOURS[i % COLOURS.length] } } : { points: { show: false } }),
    }));
    return {
      width: width(box, many), height: data.points ? 230 : 158 + (last ? 17 : 0),
      title: wide ? panel.label : undefined,
      cursor: { sync: data.points ? undefined : { key: box.dataset.key, scales: ["x", null] }, drag: { x: true, y: false } },
      scales: { x: { time: false, ...(data.points ? { range: (_, a, b) => [a - 0.04 * (b - a || 1), b + 0.04 * (b - a || 1)] } : {}) }, y: { distr: panel.log ? 3 : 1, ...(panel.level != null ? { range: (_, a, b) => reach(a, b, panel) } : {}) } },
      axes: [
        { show: true, label: last ? data.label : undefined, labelSize: 18, size: 30, font: "11px system-ui, sans-serif", labelFont: "11px system-ui, sans-serif", grid: { stroke: "#e6eaef", width: 1 } },
        { label: wide ? undefined : panel.label, labelSize: 18, size: 54, font: "11px system-ui, sans-serif", labelFont: "11px system-ui, sans-serif", grid: { stroke: "#e6eaef", width: 1, ...(panel.log ? { filter: ruled } : {}) }, ticks: panel.log ? { filter: ruled } : {}, values: (_, ticks) => (panel.log ? decades(ticks) : ticks.map(rounded)) },
      ],
      series: [{ label: data.points ? "case" : data.label, value: (_, v, __, i) => (data.names && i != null ? data.names[i] : rounded(v)) }, ...series],
      hooks: { draw: [...(panel.level != null ? [level(panel.level)] : []), ...(data.mark != null ? [mark(data.mark)] : [])] },
    };
  }

  function reach(low, high, panel) { // the scale of a frame holds its dashed line as well
    const a = Math.min(low ?? panel.level, panel.level), b = Math.max(high ?? panel.level, panel.level);
    if (panel.log) return uPlot.rangeLog(a, b, 10, false);
    return uPlot.rangeNum(a, b, 0.1, true);
  }

  let keys = 0;
  function draw(box) {
    if (drawn.has(box)) return;
    const data = JSON.parse(box.querySelector("script").textContent);
    box.dataset.key = `chart${keys++}`;
    const x = unpack(data.x);
    box.plots = data.panels.map((panel, k) =>
      new uPlot(options(box, data, panel, k), [x, ...panel.lines.map(line => unpack(line.y))], box));
    box.data = data;
    drawn.set(box, box.plots);
    for (const plot of box.plots) plot.over.addEventListener("dblclick", () => show(box, x[0], x[x.length - 1]));
    for (const label of box.querySelectorAll(".u-series:not(:first-child):not(:nth-child(2):last-child) th")) {
      label.tabIndex = 0;
      label.setAttribute("role", "button");
      label.classList.add("pressable"); // hides and shows its line
    }
    box.addEventListener("keydown", event => {
      if (event.ctrlKey || event.altKey || event.metaKey) return; // those of the browser
      (event.shiftKey && event.key.startsWith("Arrow") ? point : zoom)(box, x, event); // Shift may be needed to type a +
    });
  }

  function point(box, x, event) { // Shift and arrows move the cross by a hundredth of what is shown, or to the next sample
    if (event.key !== "ArrowLeft" && event.key !== "ArrowRight") return;
    event.preventDefault();
    const way = event.key === "ArrowRight" ? 1 : -1, plots = drawn.get(box), { min, max } = plots[0].scales.x;
    let at = plots[0].cursor.idx ?? x.findIndex(v => v >= (min + max) / 2);
    const from = x[at], inside = i => i >= 0 && i < x.length && x[i] >= min && x[i] <= max;
    while (inside(at + way) && Math.abs(x[at] - from) < (max - min) / 100) at += way;
    for (const plot of plots) plot.setCursor({ left: plot.valToPos(x[at], "x"), top: plot.over.clientHeight / 2 });
  }

  function show(box, min, max) { for (const plot of drawn.get(box)) plot.setScale("x", { min, max }); }

  function zoom(box, x, event) { // arrows move, + and - zoom, 0 shows all
    const scale = drawn.get(box)[0].scales.x, first = x[0], end = x[x.length - 1];
    let { min, max } = scale;
    const span = max - min, middle = (max + min) / 2;
    if (event.key === "ArrowLeft") { min -= span / 5; max -= span / 5; }
    else if (event.key === "ArrowRight") { min += span / 5; max += span / 5; }
    else if (event.key === "+" || event.key === "=") { min = middle - span / 4; max = middle + span / 4; }
    else if (event.key === "-") { min = middle - span; max = middle + span; }
    else if (event.key === "0" || event.key === "Home") { min = first; max = end; }
    else return;
    event.preventDefault();
    if (min < first) { max = Math.min(end, max + first - min); min = first; }
    if (max > end) { min = Math.max(first, min - (max - end)); max = end; }
    show(box, min, max);
  }

  function drawVisible() {
    for (const box of document.querySelectorAll(".chart")) if (box.offsetParent !== null) draw(box);
  }
  function resize() {
    for (const [box, plots] of drawn) {
      if (box.offsetParent === null) continue;
      for (const plot of plots) plot.setSize({ width: width(box, columns(box, box.data)), height: plot.height });
    }
  }
  addEventListener("shown", drawVisible);
  document.addEventListener("toggle", drawVisible, true);
  addEventListener("resize", resize);
  addEventListener("beforeprint", () => { document.body.classList.add("paper"); drawVisible(); resize(); });
  addEventListener("afterprint", () => { document.body.classList.remove("paper"); resize(); });
  drawVisible();
})();
