// What Chromium paints of benchmarked SVGs beside what resvg paints: PSNR of both against the portrait, and of each other.
//
// Usage: node tests/bench/viewers.mjs FOLDER [WAY]     FOLDER: a table's folder that `npm run bench -- --out` wrote
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { chromium } from '@playwright/test';
import { systemChromium } from '../e2e/chromium.mjs';

const [folder, way = 'best'] = process.argv.slice(2);
if (!folder) throw new Error('Usage: node tests/bench/viewers.mjs FOLDER [WAY]');

const pngUrl = (bytes) => `data:image/png;base64,${bytes.toString('base64')}`;

/** In the page: PSNR in dB of three pictures of one size, pair by pair, over white. */
async function compare({ target, resvg, painted }) {
  const load = async (url) => {
    const image = new Image();
    image.src = url;
    await image.decode();
    return image;
  };
  const goal = await load(target);
  const { naturalWidth: width, naturalHeight: height } = goal;
  const pixels = (image) => {
    const context = new OffscreenCanvas(width, height).getContext('2d');
    context.fillStyle = 'white';
    context.fillRect(0, 0, width, height);
    context.drawImage(image, 0, 0, width, height);
    return context.getImageData(0, 0, width, height).data;
  };
  const psnr = (a, b) => {
    let sum = 0;
    for (let i = 0; i < a.length; i++) if (i % 4 !== 3) sum += (a[i] - b[i]) ** 2;
    return 10 * Math.log10((255 ** 2 * 3 * width * height) / sum);
  };
  const [wanted, ofResvg, ofChromium] = [goal, await load(resvg), await load(painted)].map(pixels);
  return [psnr(ofResvg, wanted), psnr(ofChromium, wanted), psnr(ofChromium, ofResvg)];
}

const portraits = readdirSync(folder, { withFileTypes: true })
  .filter((entry) => entry.isDirectory() && readdirSync(join(folder, entry.name)).includes(`${way}.svg`))
  .map((entry) => entry.name);
const browser = await chromium.launch(systemChromium());
const page = await browser.newPage({ viewport: { width: 1024, height: 1024 } });
const rows = [];
for (const portrait of portraits) {
  const file = (name) => join(folder, portrait, name);
  await page.setContent(`<style>body { margin: 0 } svg { display: block }</style>${readFileSync(file(`${way}.svg`))}`);
  const painted = await page.locator('svg').screenshot();
  await page.setContent('');
  const urls = {
    target: pngUrl(readFileSync(file('target.png'))),
    resvg: pngUrl(readFileSync(file(`${way}.png`))),
    painted: pngUrl(painted),
  };
  rows.push([portrait, ...(await page.evaluate(compare, urls))]);
}
await browser.close();

const mean = [1, 2, 3].map((column) => rows.reduce((sum, row) => sum + row[column], 0) / rows.length);
console.log(`| ${way} | resvg | Chromium | of each other |\n|---|---|---|---|`);
for (const [name, ...values] of [...rows, ['mean', ...mean]]) {
  console.log(`| ${name} | ${values.map((value) => value.toFixed(2)).join(' | ')} |`);
}
