// What npm's tinyusdz finds in a file: `node round_trip.mjs PACKAGE FILE` prints meshes, triangles and the box of all
// points as JSON.
import fs from "fs";

import {check, makeReader} from "../../support/tinyusdz.mjs";

const [folder, file] = process.argv.slice(2);
const reader = await makeReader(folder);
reader.setLoadTextureInNative(false);
check(reader, reader.loadFromBinary(fs.readFileSync(file), file));
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
