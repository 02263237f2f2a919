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

  let current = 0, mode = "side", swipe = 0.5, shown = "a", blinking = true;
  let pixel = { x: 0, y: 0 };
  let loaded = null; // of the current picture: a and b as {width, height, data}, flip as an image

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

  const same_size = () => loaded.a && loaded.b && loaded.a.width === loaded.b.width && loaded.a.height === loaded.b.height;
  const needs_both = (which) => which === "swipe" || which === "difference" || which === "flip";
  const possible = (which) => !needs_both(which) || (same_size() && (which !== "flip" || loaded.flip));

  function difference() {
    const result = new ImageData(loaded.a.width, loaded.a.height);
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
    const caption = (which) => `${names[which]}: ${picture[which]}`;
    if (!possible(mode)) mode = "side";
    if (mode === "side") {
      paint(figures.a, loaded.a, caption("a"));
      paint(figures.b, loaded.b, caption("b"));
    } else {
      paint(figures.b, null);
      if (mode === "swipe") paint(figures.a, swiped(), `${caption("a")} | ${caption("b")}`);
      if (mode === "blink") paint(figures.a, loaded[shown] || loaded.a || loaded.b, caption(shown));
      if (mode === "difference") paint(figures.a, difference(), "difference of A and B, times 8");
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
    const [a, b, flip] = await Promise.all([picture.data_a, picture.data_b, picture.data_flip].map(image_of));
    if (wanted !== current) return;
    loaded = { a: pixels_of(a), b: pixels_of(b), flip: pixels_of(flip) };
    shown = "a";
    document.getElementById("picture").textContent = picture.name;
    document.getElementById("why").textContent = picture.why;
    for (const row of rows) row.setAttribute("aria-current", Number(row.dataset.picture) === current);
    section.hidden = false;
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
