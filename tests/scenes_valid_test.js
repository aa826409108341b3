// Asks the Khronos glTF validator about every .glb of a folder: no errors, no warnings.
//
// usage: node scenes_valid_test.js FOLDER
// The validator is the npm package gltf-validator. It is looked for where WHITTLE_GLTF_VALIDATOR says (the
// package's folder), then where node finds packages. Exits with 77 where there is none, 1 where a scene is
// not valid.
'use strict';
const fs = require('fs');
const path = require('path');

const kMostSevere = 1;  // 0: error, 1: warning, 2: information, 3: hint

function findValidator() {
  for (const place of [process.env.WHITTLE_GLTF_VALIDATOR, 'gltf-validator']) {
    try {
      if (place) return require(place);
    } catch (error) {
      if (error.code !== 'MODULE_NOT_FOUND') throw error;
    }
  }
  return null;
}

async function faultsOf(validator, file) {
  const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), {maxIssues: 0});
  return report.issues.messages.filter((issue) => issue.severity <= kMostSevere);
}

async function main(folder) {
  const validator = findValidator();
  if (!validator) {
    console.log('skipped: no npm package gltf-validator; WHITTLE_GLTF_VALIDATOR can name its folder');
    return 77;
  }
  const scenes = fs.readdirSync(folder).filter((name) => name.endsWith('.glb'));
  let faults = 0;
  for (const name of scenes) {
    for (const issue of await faultsOf(validator, path.join(folder, name))) {
      console.log(`${name}: ${issue.code} at ${issue.pointer}: ${issue.message}`);
      faults += 1;
    }
  }
  console.log(`${scenes.length} scenes, ${faults} faults, validator ${validator.version()}`);
  return scenes.length > 0 && faults === 0 ? 0 : 1;
}

main(process.argv[2]).then((status) => process.exit(status));
