// What every page that visits the index.html beside it has in common: its frame, and the way of what `visit` finds out.
"use strict";
const frame = document.getElementById("page");
const sleep = (ms) => new Promise((resolve) => setTimeout(resolve, ms));

window.addEventListener("load", () =>
  visit().catch((error) => ({ error: String(error) })).then((result) => {
    document.getElementById("result").textContent = JSON.stringify(result);
  }));
