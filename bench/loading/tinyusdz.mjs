// Reads one file by npm's tinyusdz: `node tinyusdz.mjs PACKAGE layer|scene FILE` prints seconds and peak bytes as JSON.
import fs from "fs";

import {check, makeReader} from "../../tests/support/tinyusdz.mjs";

const [folder, what, file] = process.argv.slice(2);
const reader = await makeReader(folder);
const bytes = fs.readFileSync(file);
const begin = performance.now();
const read = what === "layer" ? reader.loadAsLayerFromBinary(bytes, file) : reader.loadFromBinary(bytes, file);
const seconds = (performance.now() - begin) / 1000;
check(reader, read);
console.log(JSON.stringify({seconds, peak_bytes: process.resourceUsage().maxRSS * 1024}));
