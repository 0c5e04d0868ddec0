// npm's tinyusdz, another reader of USD, in node: it was compiled for browsers, and asks.
import fs from "fs";

globalThis.window = globalThis;
process.type = "renderer";

/** A reader for one file. `folder` is the package's: node_modules/tinyusdz. */
export async function makeReader(folder) {
  const {default: load} = await import(`${folder}/tinyusdz.js`);
  const tinyusdz = await load({wasmBinary: fs.readFileSync(`${folder}/tinyusdz.wasm`)});
  return new tinyusdz.TinyUSDZLoaderNative();
}

/** Ends the process with what the reader says, where it could not read. */
export function check(reader, read) {
  if (read) return;
  console.error(`tinyusdz: ${reader.error()}`);
  process.exit(1);
}
