// validate_glb.js FOLDER FILE...: what the Khronos validator, installed in FOLDER, has against each file, as JSON.
const path = require("path"), fs = require("fs");
const validator = require(path.join(process.argv[2], "node_modules/gltf-validator"));
Promise.all(process.argv.slice(3).map((file) => validator.validateBytes(new Uint8Array(fs.readFileSync(file))))).then(
  (reports) => console.log(JSON.stringify(reports.map(({ issues, info }) => ({ issues, animations: info.animationCount })))),
  (error) => { console.error(String(error)); process.exit(1); });
