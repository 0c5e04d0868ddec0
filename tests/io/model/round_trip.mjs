// What npm's tinyusdz finds in a file: `node round_trip.mjs PACKAGE FILE` prints meshes, triangles and the box of all points.
import fs from "fs";

globalThis.window = globalThis; // it was compiled for browsers, and asks
process.type = "renderer";
const [folder, file] = process.argv.slice(2);
const {default: load} = await import(`${folder}/tinyusdz.js`);
const tinyusdz = await load({wasmBinary: fs.readFileSync(`${folder}/tinyusdz.wasm`)});
const reader = new tinyusdz.TinyUSDZLoaderNative();
reader.setLoadTextureInNative(false);
if (!reader.loadFromBinary(fs.readFileSync(file), file)) {
  console.error(`tinyusdz: ${reader.error()}`);
  process.exit(1);
}
let triangles = 0;
const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
for (let i = 0; i < reader.numMeshes(); ++i) {
  const mesh = reader.getMesh(i);
  triangles += mesh.faceVertexIndices.length / 3;
  mesh.points.forEach((value, at) => {
    low[at % 3] = Math.min(low[at % 3], value);
    high[at % 3] = Math.max(high[at % 3], value);
  });
}
console.log(JSON.stringify({meshes: reader.numMeshes(), triangles, low, high}));
