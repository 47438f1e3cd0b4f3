// The main job as a newcomer does it, on six portraits: upload, drag a lip, undo, play the demo, export, reopen.
// Usage: node tests/bench/six_portraits.mjs OUT [standard|draft] [NAME…]   (after `npm run build`; portraits of the development data)
// Writes screenshots, exports and `figures.json` into OUT/NAME, and prints a row for each portrait.
import { execFileSync } from 'node:child_process';
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { chromium } from '@playwright/test';
import { systemChromium } from '../e2e/chromium.mjs';
import { serveEditor } from '../e2e/serving.mjs';
import { changedPixels, triangleChanges } from './changed_pixels.mjs';

const ROOT = join(import.meta.dirname, '../..');
const BIN = join(ROOT, '.venv/bin');
const PORTRAITS = join(process.env.VECTORTALKER_SHARED ?? join(ROOT, '../shared'), 'data/portraits');
const FILES = [
  'photo-astronaut.png',
  'painting-mona-lisa.jpg',
  'anime-eileen.png',
  'cartoon-avataaars.png',
  'manga-lucy.png',
  'watercolour-ada-lovelace.jpg',
];
const DRAG_PIXELS = 20; // on the screen
const LIMIT = 1_200_000; // milliseconds of any wait: a busy machine is no failure
const DEMO_SECONDS = { rest: 0, blink: 0.6, smile: 1.6, gaze: 2.6, round: 3.9, open: 4.92, press: 5.6, tilt: 6.7 };

const stage = (page) => page.getByRole('main', { name: 'Stage' });
const settled = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));

/**
 * The bare picture, without points, options and messages. It is painted as a whole: where the browser paints only what
 * changed, its antialiasing depends on what that was.
 */
async function pictureShot(page, path) {
  const show = (visibility) =>
    page.evaluate((value) => {
      for (const element of document.querySelectorAll('.overlay, .insets, .stage-options, .hint, .stage-messages'))
        element.style.visibility = value;
    }, visibility);
  const display = (value) =>
    page.evaluate((next) => {
      for (const picture of document.querySelectorAll('.picture')) picture.style.display = next;
    }, value);
  await show('hidden');
  await display('none');
  await settled(page);
  await display('');
  await settled(page);
  const shot = await stage(page).screenshot({ animations: 'disabled', path });
  await show('');
  return shot;
}

/** What every path of the picture is told to look like. */
const pathData = (page) =>
  page.evaluate(() => Array.from(document.querySelectorAll('#back path, #fore path, #local path'), (path) => path.getAttribute('d')));

async function trace(page, url, file, preset) {
  await page.goto(url);
  await page.getByRole('radio', { name: preset, exact: false }).check();
  const dialog = page.waitForEvent('filechooser');
  await page.getByRole('button', { name: 'Choose a file' }).click();
  const start = Date.now();
  await (await dialog).setFiles(join(PORTRAITS, file));
  await page.getByRole('region', { name: 'Progress' }).waitFor();
  await page.locator('#fore path').first().waitFor({ state: 'attached' });
  const firstPicture = (Date.now() - start) / 1000;
  await page.getByRole('region', { name: 'Progress' }).waitFor({ state: 'hidden' });
  await page.locator('.overlay [data-landmark="57"]').waitFor();
  return { firstPicture, seconds: (Date.now() - start) / 1000 };
}

/** Drags the middle of the lower lip alone. */
async function dragLip(page) {
  const box = await page.locator('.overlay [data-landmark="57"]').boundingBox();
  const from = { x: box.x + box.width / 2, y: box.y + box.height / 2 };
  await page.keyboard.down('Alt');
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move(from.x, from.y + DRAG_PIXELS / 2);
  await page.mouse.move(from.x, from.y + DRAG_PIXELS);
  await page.mouse.up();
  await page.keyboard.up('Alt');
  await settled(page);
}

async function undo(page) {
  await page.getByRole('button', { name: 'Undo' }).click();
  await settled(page);
}

/** Counts pixels that a dragged lip changes in the triangles that moved, beside them, and elsewhere; undoes the drag. */
async function poseLip(page, out) {
  const mesh = async () => (await page.locator('.overlay .mesh').getAttribute('d')) ?? '';
  await page.getByRole('button', { name: 'Pose', exact: true }).click(); // doubtful landmarks open in the other tool
  await page.getByRole('button', { name: 'Mesh' }).click();
  const [restMesh, restPaths, restShot] = [await mesh(), await pathData(page), await pictureShot(page)];
  await dragLip(page);
  await page.screenshot({ path: join(out, 'drag.png') });
  const counts = await triangleChanges(page, restMesh, await mesh(), restShot, await pictureShot(page, join(out, 'drag-picture.png')));
  const posedPaths = await pathData(page);
  await undo(page);
  const undone = await pathData(page);
  const differ = (paths) => restPaths.filter((d, index) => d !== paths[index]).length;
  const afterUndo = await changedPixels(page, restShot, await pictureShot(page));
  await page.getByRole('button', { name: 'Mesh' }).click();
  return { ...counts, paths: restPaths.length, movedPaths: differ(posedPaths), pathsAfterUndo: differ(undone), afterUndo };
}

/** Plays the demo for real, then scrubs to telling moments; returns changed pixels against rest. */
async function playDemo(page, out) {
  await page.getByRole('button', { name: 'Play the demo' }).click();
  const first = await stage(page).screenshot();
  await page.waitForTimeout(700);
  const whilePlaying = await changedPixels(page, first, await stage(page).screenshot());
  await page.getByRole('button', { name: 'Pause' }).click();
  const changed = {};
  let rest;
  for (const [name, seconds] of Object.entries(DEMO_SECONDS)) {
    await page.getByRole('slider', { name: 'Playhead' }).fill(`${seconds}`);
    const shot = await pictureShot(page, join(out, `demo-${name}.png`));
    rest ??= shot;
    changed[name] = await changedPixels(page, rest, shot);
  }
  await page.screenshot({ path: join(out, 'editor-demo.png') });
  await page.getByRole('button', { name: 'Back to the start' }).click();
  return { whilePlaying, changed };
}

async function download(page, press, path) {
  const [file] = await Promise.all([page.waitForEvent('download'), press()]);
  await file.saveAs(path);
  return path;
}

async function exportAll(page, out) {
  const save = () => page.getByRole('button', { name: 'Save' }).click();
  const files = { vtalk: await download(page, save, join(out, 'project.vtalk')) };
  await page.getByText('Export', { exact: true }).click();
  for (const [label, ending] of Object.entries({ SVG: 'still.svg', 'Animated SVG': 'animated.svg', 'MP4 video': 'video.mp4' })) {
    await page.getByRole('button', { name: new RegExp(`^${label}`) }).click();
    const start = () => page.getByRole('button', { name: 'Download' }).click();
    files[ending] = await download(page, start, join(out, ending));
  }
  return files;
}

/** Shows an exported SVG in an `<img>`, where no script runs, twice within 0.4 s during the demo's speech. */
async function imageMoves(context, file) {
  const page = await context.newPage();
  await page.setContent(`<img alt="" width="512" src="data:image/svg+xml;base64,${readFileSync(file).toString('base64')}">`);
  const image = page.locator('img');
  await page.waitForTimeout(3600); // the demo speaks from 3.3 s on
  const shots = [await image.screenshot({ animations: 'allow' })];
  await page.waitForTimeout(400);
  shots.push(await image.screenshot({ animations: 'allow' }));
  const moved = await changedPixels(page, ...shots);
  await page.close();
  return moved;
}

async function verify(browser, url, file, preset, folder) {
  const name = file.replace(/\.\w+$/, '');
  const out = join(folder, name);
  mkdirSync(out, { recursive: true });
  const context = await browser.newContext({ viewport: { width: 1440, height: 900 } });
  context.setDefaultTimeout(LIMIT);
  const page = await context.newPage();
  const faults = [];
  page.on('pageerror', (error) => faults.push(`${error}`));
  page.on('console', (message) => message.type() === 'error' && faults.push(message.text()));
  const figures = { name, preset, trace: await trace(page, url, file, preset) };
  await page.screenshot({ path: join(out, 'editor.png') });
  await pictureShot(page, join(out, 'rest.png'));
  figures.drag = await poseLip(page, out);
  figures.demo = await playDemo(page, out);
  const files = await exportAll(page, out);
  await page.close(); // the exports must move by themselves
  figures.still = await imageMoves(context, files['still.svg']);
  figures.animated = await imageMoves(context, files['animated.svg']);
  await context.close();
  const reopened = execFileSync(join(BIN, 'python'), [join(import.meta.dirname, 'reopened.py'), files['video.mp4'], files.vtalk]);
  Object.assign(figures, JSON.parse(reopened.toString()), { faults });
  writeFileSync(join(out, 'figures.json'), `${JSON.stringify(figures, null, 2)}\n`);
  return figures;
}

const [folder, preset = 'standard', ...names] = process.argv.slice(2);
if (!folder) throw new Error('Usage: node tests/bench/six_portraits.mjs OUT [standard|draft] [NAME…]');
const { url, stop } = await serveEditor();
const browser = await chromium.launch(systemChromium());
try {
  for (const file of FILES.filter((candidate) => names.length === 0 || names.some((name) => candidate.includes(name))))
    console.log(JSON.stringify(await verify(browser, url, file, preset, folder)));
} finally {
  await browser.close();
  stop();
}
