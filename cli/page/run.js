// Moves a run's page: the slider, the keys, the strip and the plots all seek; views, cursor and read-outs follow.
(() => {
  "use strict";
  const player = document.getElementById("player");
  if (!player) return; // a run without frames
  const run = JSON.parse(document.getElementById("run").textContent);
  const slider = document.getElementById("frame");
  const clock = document.getElementById("clock");
  const play = document.getElementById("play");
  const pictures = [...player.querySelectorAll(".view img")];
  const neighbours = 4; // frames loaded ahead of need, either side
  let frame = run.start;
  let fresh = true; // nobody has chosen a frame yet: playing begins at the beginning

  const clamp = (value, low, high) => Math.min(Math.max(value, low), high);
  const time_of = (number) => (number - 1) / run.fps;
  const share_of = (time) => (run.end > run.begin ? (time - run.begin) / (run.end - run.begin) : 0);
  const file_of = (view, number) => `${view}/frame_${String(number).padStart(4, "0")}.png`;

  // Where only some frames were drawn, the others are passed over.
  const listed = run.listed;
  const last = listed.length ? listed[listed.length - 1] : run.last;
  function place_of(number) {
    let low = 0, high = listed.length - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (listed[middle] <= number) low = middle;
      else high = middle - 1;
    }
    return low;
  }
  const drawn_before = (number) => (listed.length ? listed[place_of(number)] : clamp(number, run.first, run.last));
  const drawn_after = (number, steps) =>
    listed.length ? listed[clamp(place_of(number) + steps, 0, listed.length - 1)] : clamp(number + steps, run.first, run.last);

  // Frames around the shown one, by file. Those far away are let go.
  const loaded = new Map();
  function load(file) {
    if (!loaded.has(file)) {
      const picture = new Image();
      picture.src = file;
      loaded.set(file, picture);
    }
    return loaded.get(file);
  }
  function load_around(number) {
    const near = new Set();
    for (let k = -neighbours; k <= neighbours; ++k)
      for (const view of run.views) near.add(file_of(view, drawn_after(number, k)));
    for (const file of [...loaded.keys()]) if (!near.has(file)) loaded.delete(file);
    near.forEach(load);
  }
  const ready = (number) => run.views.every((view) => load(file_of(view, number)).complete);

  // A plotted line keeps its numbers in its points: x in thousandths of the time axis, y downwards from data-high to
  // data-low.
  const lines = [...player.querySelectorAll("figure.plot:has(.axes)")].flatMap((plot) => {
    const low = Number(plot.dataset.low), high = Number(plot.dataset.high);
    const height = plot.querySelector(".axes > svg").viewBox.baseVal.height;
    const outputs = plot.querySelectorAll("output");
    return [...plot.querySelectorAll("polyline")].map((line, k) => ({
      points: [...line.points].map((p) => [p.x, p.y]),
      value: (y) => high - (y / height) * (high - low),
      decimals: Number(plot.dataset.decimals),
      prefix: plot.dataset.prefix,
      output: outputs[k],
    }));
  });
  function height_at(points, x) {
    let low = 0, high = points.length - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (points[middle][0] <= x) low = middle;
      else high = middle;
    }
    const [x0, y0] = points[low], [x1, y1] = points[high];
    return x1 > x0 ? y0 + ((y1 - y0) * clamp(x - x0, 0, x1 - x0)) / (x1 - x0) : y0;
  }
  function read_lines(x) {
    for (const line of lines.filter((line) => line.points.length > 0)) {
      const y = height_at(line.points, x);
      const zero = (0).toFixed(line.decimals);
      const text = line.value(y).toFixed(line.decimals);
      line.output.textContent = line.prefix + (text === "-" + zero ? zero : text.replace("-", "\u2212"));
    }
  }

  const grouped = (number) => String(number).replace(/\B(?=(\d{3})+$)/g, ",");

  function show(number) {
    frame = drawn_before(Math.round(number));
    const time = time_of(frame);
    pictures.forEach((picture, k) => {
      picture.src = file_of(run.views[k], frame);
      picture.alt = `${run.views[k]}, frame ${frame}`;
    });
    clock.textContent = `${time.toFixed(run.decimals)} s, frame ${grouped(frame)} of ${grouped(run.of)}`;
    slider.value = frame;
    slider.setAttribute("aria-valuetext", clock.textContent);
    player.style.setProperty("--at", share_of(time));
    read_lines(1000 * share_of(time));
    document.dispatchEvent(new CustomEvent("billow-time", { detail: time })); // viewer.js
    load_around(frame);
  }
  function seek(number) {
    pause();
    fresh = false;
    show(number);
  }

  // In real time, but never past a frame that is still loading.
  let playing = false, shown_at = 0;
  function pause() {
    playing = false;
    play.setAttribute("aria-pressed", "false");
    play.setAttribute("aria-label", "Play");
  }
  function start() {
    if (fresh || frame === last) show(run.first);
    fresh = false;
    playing = true;
    play.setAttribute("aria-pressed", "true");
    play.setAttribute("aria-label", "Pause");
    shown_at = performance.now();
    setTimeout(advance, 1000 / run.fps);
  }
  function advance() {
    if (!playing) return;
    const now = performance.now();
    const due = Math.floor(((now - shown_at) * run.fps) / 1000);
    if (due > 0) {
      const next = drawn_before(frame + due);
      if (next === frame && frame !== last) {
        // the next one that was drawn is not due yet
      } else if (ready(next)) {
        shown_at += (1000 * (next - frame)) / run.fps;
        show(next);
      } else {
        shown_at = now;
      }
    }
    if (frame === last) pause();
    else setTimeout(advance, shown_at + 1000 / run.fps - performance.now());
  }

  play.addEventListener("click", () => (playing ? pause() : start()));
  slider.addEventListener("input", () => seek(slider.valueAsNumber));
  document.addEventListener("keydown", (event) => {
    if (event.altKey || event.ctrlKey || event.metaKey || event.target.closest("button, summary, a, pre")) return;
    const steps = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (steps) seek(drawn_after(frame, steps * (event.shiftKey ? 10 : 1)));
    else if (event.key === " ") playing ? pause() : start();
    else return;
    event.preventDefault();
  });

  // Pressing on the strip or a plot seeks, and dragging goes on seeking wherever the pointer is.
  let held = null;
  const seek_to = (event) => {
    const box = held.getBoundingClientRect();
    const time = run.begin + clamp((event.clientX - box.left) / box.width, 0, 1) * (run.end - run.begin);
    seek(time * run.fps + 1);
  };
  for (const lane of player.querySelectorAll(".seek"))
    lane.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      held = lane;
      seek_to(event);
    });
  window.addEventListener("pointermove", (event) => {
    if (event.buttons === 0) held = null; // let go outside the window
    if (held) seek_to(event);
  });
  for (const end of ["pointerup", "pointercancel"]) window.addEventListener(end, () => (held = null));

  window.addEventListener("beforeprint", () => {
    for (const folded of document.querySelectorAll("details")) folded.open = true;
  });
  show(frame);
})();
