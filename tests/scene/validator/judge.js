// What does Khronos' own validator say of these files? Prints a line of JSON for each: its name and its errors.
const fs = require("fs");
const path = require("path");
const validator = require("gltf-validator");

async function judge(file) {
  const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), {
    maxIssues: 100,
    externalResourceFunction: (uri) =>
      fs.promises.readFile(path.join(path.dirname(file), decodeURIComponent(uri))).then((b) => new Uint8Array(b)),
  });
  return report.issues.messages.filter((m) => m.severity === 0).map((m) => ({ code: m.code, at: m.pointer || "", message: m.message }));
}

(async () => {
  for (const file of process.argv.slice(2)) {
    const errors = await judge(file).catch((e) => [{ code: "NOT_GLTF", at: "", message: String(e) }]);
    console.log(JSON.stringify({ file, errors }));
  }
})();
