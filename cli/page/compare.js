// Shows a pair of pictures in every way that helps to see what differs, and what each pixel is.
(() => {
  "use strict";
  const pictures = JSON.parse(document.getElementById("pictures").textContent);
  if (!pictures.length) return;
  const section = document.getElementById("comparison");
  const stage = document.getElementById("stage");
  const figures = { a: stage.querySelector(".a"), b: stage.querySelector(".b") };
  const loupe = document.getElementById("loupe");
  const values = document.getElementById("values");
  const buttons = [...section.querySelectorAll("[data-mode]")];
  const modes = buttons.map((button) => button.dataset.mode);
  const rows = [...document.querySelectorAll("tr[data-picture]")];
  const gain = 8, period = 500, reach = 5; // [ms] of a blink; pixels either side in the loupe
  const names = { a: "A", b: "B" };
  const choices = document.getElementById("values-of");
  const layers = document.getElementById("layer"), exposure = document.getElementById("exposure");
  const curves = [...document.querySelectorAll(".curves")].map((element) => ({
    element, begin: Number(element.dataset.begin), end: Number(element.dataset.end), frames: JSON.parse(element.dataset.frames) }));

  let current = 0, mode = "side", swipe = 0.5, shown = "a", blinking = true;
  let pixel = { x: 0, y: 0 };
  let loaded = null; // of the current picture: a and b as {width, height, data}, flip as an image
  let numbers = null; // of one that is more than a browser decodes: a and b as {width, height, planes}, by channel

  const clamp = (value, low, high) => Math.min(Math.max(value, low), high);

  function image_of(source) {
    return new Promise((resolve) => {
      if (!source) return resolve(null);
      const image = new Image();
      image.onload = () => resolve(image);
      image.onerror = () => resolve(null);
      image.src = source;
    });
  }

  function pixels_of(image) {
    if (!image) return null;
    const canvas = document.createElement("canvas");
    canvas.width = image.naturalWidth;
    canvas.height = image.naturalHeight;
    const context = canvas.getContext("2d", { willReadFrequently: true });
    context.drawImage(image, 0, 0);
    return context.getImageData(0, 0, canvas.width, canvas.height);
  }

  // The planes of bytes that a picture holds (packed_values.h), as floats by channel.
  function unpacked(side, picture, channels) {
    if (!side || !picture) return null;
    const size = side.width * side.height, planes = {};
    channels.forEach((name, c) => {
      const bytes = new Uint8Array(4 * size);
      for (let k = 0; k < 4; ++k) {
        const plane = 4 * c + k, begin = 4 * size * Math.floor(plane / 3) + (plane % 3);
        for (let i = 0; i < size; ++i) bytes[4 * i + k] = picture.data[begin + 4 * i];
      }
      planes[name] = new Float32Array(bytes.buffer);
    });
    return { width: side.width, height: side.height, planes };
  }

  const layer_shown = () => pictures[current].values.layers[layers.selectedIndex];

  const shows_identities = (layer) => layer.identities.includes(layer.channels[0]);

  // The finite values of a layer, of both: their smallest and largest.
  function range_of(layer) {
    let low = Infinity, high = -Infinity;
    for (const side of [numbers.a, numbers.b])
      for (const name of side ? layer.channels : [])
        for (const value of side.planes[name])
          if (Number.isFinite(value)) (low = Math.min(low, value)), (high = Math.max(high, value));
    return low <= high ? { low, high } : { low: 0, high: 1 };
  }

  const encoded = (linear) => (linear <= 0.0031308 ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055);

  // How a value of a layer is shown, 0 to 1, but for NaN and identities.
  function tone_of(layer) {
    const gain = 2 ** Number(exposure.value), { white } = pictures[current].values;
    if (layer.name === "colour") return white === 1 ? (v) => encoded(clamp(v * gain, 0, 1)) : (v) => (v / white) * gain;
    const { low, high } = range_of(layer), most = Math.max(Math.abs(low), Math.abs(high)) || 1;
    if (layer.channels.length > 1) return (v) => 0.5 + (0.5 * v * gain) / most;
    return (v) => ((v - low) / (high - low || 1)) * gain;
  }

  // What black and white of a layer's picture are.
  function scale_text() {
    const layer = layer_shown(), gain = 2 ** Number(exposure.value);
    if (layer.name === "colour" || shows_identities(layer)) return "";
    const { low, high } = range_of(layer), most = Math.max(Math.abs(low), Math.abs(high)) / gain;
    const text = (value) => String(Number(value.toPrecision(3)));
    return layer.channels.length > 1 ? `, ${text(-most)} to ${text(most)}` : `, ${text(low)} to ${text(low + (high - low) / gain)}`;
  }

  // A layer as a picture: NaN is magenta, identities have colours of their own.
  function tone_mapped(side, layer) {
    if (!side) return null;
    const result = new ImageData(side.width, side.height), tone = tone_of(layer);
    const planes = layer.channels.map((name) => side.planes[name]);
    const bits = shows_identities(layer) ? new Uint32Array(planes[0].buffer) : null;
    for (let i = 0; i < side.width * side.height; ++i) {
      const mixed = bits ? Math.imul(bits[i], 2654435761) >>> 8 : 0;
      for (let c = 0; c < 3; ++c) {
        const plane = planes.length === 1 ? planes[0] : planes[c];
        const value = plane ? plane[i] : 0;
        result.data[4 * i + c] = bits ? (mixed >> (8 * c)) & 255 : Number.isNaN(value) ? (c === 1 ? 0 : 255) : 255 * tone(value);
      }
      const alpha = layer.name === "colour" && pictures[current].values.white !== 1 && planes[3];
      result.data[4 * i + 3] = alpha ? (255 * alpha[i]) / 65535 : 255;
    }
    return result;
  }

  function show_layer() {
    const layer = layer_shown();
    document.getElementById("stops").textContent = `${exposure.value} EV`;
    loaded.a = tone_mapped(numbers.a, layer);
    loaded.b = tone_mapped(numbers.b, layer);
  }

  function offer_layers(values) {
    choices.hidden = !values;
    if (!values) return;
    layers.replaceChildren(...values.layers.map((layer) => new Option(layer.channels.length === 1 ? layer.channels[0] : `${layer.name} (${layer.channels.join(", ")})`)));
    layers.selectedIndex = values.layer;
    exposure.value = 0;
  }

  // Of 255, as `billow compare` has it.
  function apart_of(a, b, exact) {
    if (a === b || (Number.isNaN(a) && Number.isNaN(b))) return 0;
    const { white } = pictures[current].values, difference = Math.abs(a - b);
    if (!Number.isFinite(difference) || exact) return 255;
    return (255 * difference) / (white === 1 ? Math.max(1, Math.abs(a), Math.abs(b)) : white);
  }

  const same_size = () => loaded.a && loaded.b && loaded.a.width === loaded.b.width && loaded.a.height === loaded.b.height;
  const needs_both = (which) => which === "swipe" || which === "difference" || which === "flip";
  const possible = (which) => !needs_both(which) || (same_size() && (which !== "flip" || loaded.flip));

  const difference_gain = () => gain * 2 ** Number(numbers ? exposure.value : 0);

  function difference_of_values(result) {
    const layer = layer_shown();
    for (let i = 0; i < result.data.length / 4; ++i) {
      const apart = layer.channels.map((name) => difference_gain() * apart_of(numbers.a.planes[name][i], numbers.b.planes[name][i], layer.identities.includes(name)));
      const most = Math.max(...apart);
      for (let c = 0; c < 3; ++c) result.data[4 * i + c] = layer.name === "colour" && apart.length >= 3 ? apart[c] : most;
      result.data[4 * i + 3] = 255;
    }
    return result;
  }

  function difference() {
    const result = new ImageData(loaded.a.width, loaded.a.height);
    if (numbers) return difference_of_values(result);
    const a = loaded.a.data, b = loaded.b.data;
    for (let k = 0; k < a.length; k += 4) {
      for (let c = 0; c < 3; ++c) result.data[k + c] = Math.min(gain * Math.abs(a[k + c] - b[k + c]), 255);
      result.data[k + 3] = 255;
    }
    return result;
  }

  // A left of the line, B right of it.
  function swiped() {
    const { width, height } = loaded.a;
    const result = new ImageData(new Uint8ClampedArray(loaded.a.data), width, height);
    const line = Math.floor(swipe * width);
    for (let y = 0; y < height; ++y)
      result.data.set(loaded.b.data.subarray(4 * (y * width + line), 4 * (y + 1) * width), 4 * (y * width + line));
    for (let y = 0; y < height && line < width; ++y) result.data.set([255, 255, 255, 255], 4 * (y * width + line));
    return result;
  }

  function paint(figure, data, caption) {
    figure.hidden = !data;
    if (!data) return;
    const canvas = figure.querySelector("canvas");
    canvas.width = data.width;
    canvas.height = data.height;
    canvas.getContext("2d").putImageData(data, 0, 0);
    figure.querySelector("figcaption").textContent = caption;
  }

  function draw() {
    const picture = pictures[current];
    const caption = (which) => `${names[which]}: ${picture[which]}${numbers ? scale_text() : ""}`;
    if (!possible(mode)) mode = "side";
    if (mode === "side") {
      paint(figures.a, loaded.a, caption("a"));
      paint(figures.b, loaded.b, caption("b"));
    } else {
      paint(figures.b, null);
      if (mode === "swipe") paint(figures.a, swiped(), `${caption("a")} | ${caption("b")}`);
      if (mode === "blink") paint(figures.a, loaded[shown] || loaded.a || loaded.b, caption(shown));
      if (mode === "difference") paint(figures.a, difference(), `difference of A and B, times ${difference_gain()}`);
      if (mode === "flip") paint(figures.a, loaded.flip, "ꟻLIP: what is seen of the difference, dark to light");
    }
    stage.className = `stage ${mode}`;
    for (const button of buttons) {
      button.setAttribute("aria-pressed", button.dataset.mode === mode);
      button.disabled = !possible(button.dataset.mode);
    }
    look();
  }

  const colour_at = (data, x, y) =>
    data && x >= 0 && y >= 0 && x < data.width && y < data.height ? [...data.data.subarray(4 * (y * data.width + x), 4 * (y * data.width + x) + 4)] : null;

  // The chosen pixel's values in the layer, a line for each channel.
  function value_lines() {
    const { channels, hashes } = layer_shown(), { white } = pictures[current].values;
    const at = (side, name) =>
      side && pixel.x < side.width && pixel.y < side.height ? side.planes[name][pixel.y * side.width + pixel.x] : undefined;
    const text = (value, digits = 6) =>
      value === undefined ? "nothing" : Number.isFinite(value) ? String(Number(value.toPrecision(digits))) : String(value);
    const hash = (value) =>
      value === undefined ? "nothing" : new Uint32Array(Float32Array.of(value).buffer)[0].toString(16).padStart(8, "0");
    const wide = Math.max(...channels.map((name) => name.length));
    const lines = channels.map((name) => {
      const a = at(numbers.a, name), b = at(numbers.b, name);
      if (hashes.includes(name)) return `${name.padEnd(wide)}   A ${hash(a)}   B ${hash(b)}   ${a === b ? "the same" : "another"}`;
      const apart = a === undefined || b === undefined ? "" : `   apart ${a === b ? 0 : text(Math.abs(a - b))}`;
      const digits = a !== b && text(a) === text(b) ? 10 : 6; // as many as tell them apart
      return `${name.padEnd(wide)}   A ${text(a, digits)}   B ${text(b, digits)}${apart}`;
    });
    return [`(${pixel.x}, ${pixel.y})${white === 1 ? "" : ` of ${white}`}`, ...lines].join("\n");
  }

  // The pixels around the chosen one, of both, and its numbers.
  function look() {
    const context = loupe.getContext("2d"), side = loupe.height / (2 * reach + 1);
    context.clearRect(0, 0, loupe.width, loupe.height);
    ["a", "b"].forEach((which, place) => {
      for (let dy = -reach; dy <= reach; ++dy)
        for (let dx = -reach; dx <= reach; ++dx) {
          const colour = colour_at(loaded[which], pixel.x + dx, pixel.y + dy);
          if (!colour) continue;
          context.fillStyle = `rgba(${colour[0]}, ${colour[1]}, ${colour[2]}, ${colour[3] / 255})`;
          context.fillRect(place * (loupe.height + 12) + (dx + reach) * side, (dy + reach) * side, side - 0.5, side - 0.5);
        }
      context.strokeStyle = "#fff";
      context.strokeRect(place * (loupe.height + 12) + reach * side, reach * side, side - 0.5, side - 0.5);
    });
    if (numbers) {
      values.textContent = value_lines();
      return;
    }
    const a = colour_at(loaded.a, pixel.x, pixel.y), b = colour_at(loaded.b, pixel.x, pixel.y);
    const text = (colour) => (!colour ? "nothing" : colour.slice(0, colour[3] === 255 ? 3 : 4).join(" "));
    const apart = a && b ? Math.max(...a.map((value, c) => Math.abs(value - b[c]))) : "";
    values.textContent = `(${pixel.x}, ${pixel.y})   A ${text(a)}   B ${text(b)}${a && b ? `   apart ${apart}` : ""}`;
  }

  function choose(next) {
    const data = loaded.a || loaded.b;
    if (!data) return;
    pixel = { x: clamp(next.x, 0, data.width - 1), y: clamp(next.y, 0, data.height - 1) };
    look();
  }

  async function show(number) {
    current = clamp(number, 0, pictures.length - 1);
    const picture = pictures[current], wanted = current;
    const packed = picture.values;
    const sources = packed ? [packed.a?.data, packed.b?.data] : [picture.data_a, picture.data_b];
    const [a, b, flip] = (await Promise.all([...sources, picture.data_flip].map(image_of))).map(pixels_of);
    if (wanted !== current) return;
    loaded = { a, b, flip };
    numbers = null;
    offer_layers(packed);
    if (packed) {
      const channels = packed.layers.flatMap((layer) => layer.channels);
      numbers = { a: unpacked(packed.a, a, channels), b: unpacked(packed.b, b, channels) };
      show_layer();
    }
    shown = "a";
    document.getElementById("picture").textContent = picture.name;
    document.getElementById("why").textContent = picture.why;
    for (const row of rows) row.setAttribute("aria-current", Number(row.dataset.picture) === current);
    section.hidden = false;
    for (const { element, begin, end, frames } of curves) {
      const frame = frames.find(([, place]) => place === current);
      element.style.setProperty("--at", frame ? (frame[0] - begin) / (end - begin) : -1);
      element.classList.toggle("elsewhere", !frame);
    }
    pixel = { x: picture.worst ? picture.worst[0] : 0, y: picture.worst ? picture.worst[1] : 0 };
    draw();
  }

  function set_mode(which) {
    if (!loaded || !possible(which)) return;
    mode = which;
    blinking = true;
    draw();
  }

  setInterval(() => {
    if (mode !== "blink" || !blinking || !loaded) return;
    shown = shown === "a" ? "b" : "a";
    draw();
  }, period);

  // A button that was clicked gives the keyboard back: Space is the picture's.
  buttons.forEach((button) => button.addEventListener("click", () => (button.blur(), set_mode(button.dataset.mode))));
  for (const row of rows)
    row.querySelector("button")?.addEventListener("click", (event) => {
      event.currentTarget.blur();
      show(Number(row.dataset.picture));
      section.scrollIntoView({ block: "start" });
    });

  // A press on a curve shows the frame that is nearest to it, of those that the page has.
  for (const { element, begin, end, frames } of curves)
    for (const axes of element.querySelectorAll(".axes"))
      axes.addEventListener("click", (event) => {
        const box = axes.getBoundingClientRect();
        const wanted = begin + ((event.clientX - box.left) / box.width) * (end - begin);
        const nearest = frames.reduce((best, frame) => (Math.abs(frame[0] - wanted) < Math.abs(best[0] - wanted) ? frame : best), frames[0]);
        if (nearest) show(nearest[1]);
      });

  for (const control of [layers, exposure])
    control.addEventListener("input", () => {
      show_layer();
      draw();
    });

  for (const figure of Object.values(figures))
    figure.querySelector("canvas").addEventListener("pointermove", (event) => {
      const canvas = event.currentTarget, box = canvas.getBoundingClientRect();
      const share = (event.clientX - box.left) / box.width;
      if (mode === "swipe") (swipe = clamp(share, 0, 1)), draw();
      choose({ x: Math.floor(share * canvas.width), y: Math.floor(((event.clientY - box.top) / box.height) * canvas.height) });
    });

  const steps = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey || !loaded) return;
    if (event.target === layers || event.target === exposure) return;
    const step = steps[event.key];
    if (step && event.shiftKey) choose({ x: pixel.x + step[0], y: pixel.y + step[1] });
    else if (event.key === "ArrowLeft" || event.key === "ArrowRight") show(current + step[0]);
    else if (event.key === "w" || event.key === "W") choose({ x: (pictures[current].worst || [0])[0], y: (pictures[current].worst || [0, 0])[1] });
    else if (event.key === " " && event.target.tagName !== "BUTTON") {
      if (mode === "blink") blinking = !blinking;
      else (mode = "blink"), (blinking = false), (shown = "b");
      draw();
    } else if (modes[Number(event.key) - 1]) set_mode(modes[Number(event.key) - 1]);
    else return;
    event.preventDefault();
  });

  show(0);
})();
