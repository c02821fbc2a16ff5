// Writes a file of glTF in every combination of what glTF-Transform packs it with:
//
//   node transform.mjs in.glb FOLDER
//
// One file each, called after what was done: "draco+webp+sparse.glb". Prints the names.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { Logger, NodeIO } from '@gltf-transform/core';
import { ALL_EXTENSIONS } from '@gltf-transform/extensions';
import { draco, instance, meshopt, quantize, sparse, textureCompress } from '@gltf-transform/functions';
import draco3d from 'draco3dgltf';
import { MeshoptDecoder, MeshoptEncoder } from 'meshoptimizer';
import sharp from 'sharp';

const [source, folder] = process.argv.slice(2);
await MeshoptEncoder.ready;
const io = new NodeIO().registerExtensions(ALL_EXTENSIONS).registerDependencies({
  'draco3d.decoder': await draco3d.createDecoderModule(),
  'draco3d.encoder': await draco3d.createEncoderModule(),
  'meshopt.decoder': MeshoptDecoder,
  'meshopt.encoder': MeshoptEncoder,
});
const codecs = {
  '': [],
  quantize: [quantize()],
  draco: [draco()],
  meshopt: [meshopt({ encoder: MeshoptEncoder })],
};
const extras = {
  webp: textureCompress({ encoder: sharp, targetFormat: 'webp', lossless: true }),
  sparse: sparse(),
  instancing: instance({ min: 2 }),
};
for (const [codec, packing] of Object.entries(codecs))
  for (let chosen = 0; chosen < 8; ++chosen) {
    const names = Object.keys(extras).filter((_, i) => (chosen >> i) & 1);
    const document = await io.readBinary(new Uint8Array(readFileSync(source)));
    document.setLogger(new Logger(Logger.Verbosity.ERROR));
    // Instances first: packing must see the nodes that stay.
    const steps = [...names].reverse().map((name) => extras[name]);
    await document.transform(...steps, ...packing);
    const name = [codec, ...names].filter(Boolean).join('+') || 'plain';
    await io.write(join(folder, `${name}.glb`), document);
    console.log(name);
  }
