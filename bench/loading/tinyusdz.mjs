// Reads one file by npm's tinyusdz: `node tinyusdz.mjs PACKAGE layer|scene FILE` prints seconds and peak bytes as JSON.
import fs from "fs";

globalThis.window = globalThis; // it was compiled for browsers, and asks
process.type = "renderer";
const [folder, what, file] = process.argv.slice(2);
const {default: load} = await import(`${folder}/tinyusdz.js`);
const tinyusdz = await load({wasmBinary: fs.readFileSync(`${folder}/tinyusdz.wasm`)});
const bytes = fs.readFileSync(file);
const reader = new tinyusdz.TinyUSDZLoaderNative();
const begin = performance.now();
const read = what === "layer" ? reader.loadAsLayerFromBinary(bytes, file) : reader.loadFromBinary(bytes, file);
const seconds = (performance.now() - begin) / 1000;
if (!read) {
  console.error(`tinyusdz: ${reader.error()}`);
  process.exit(1);
}
console.log(JSON.stringify({seconds, peak_bytes: process.resourceUsage().maxRSS * 1024}));
