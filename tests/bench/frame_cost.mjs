// CPU milliseconds of the page's main thread per animation frame while a mouth pose is dragged, and what a frame writes.
// Usage: node tests/bench/frame_cost.mjs PROJECT.vtalk [DIST]   (after `npm run build`; software raster, so read it as an upper bound)
//
// CPU time is that of the whole main thread as Chromium's Performance domain counts it, without tracing. A busy neighbour on the
// same core makes any code slower, by a factor of two and more: bursts are short, their spread is shown, and so is what a fixed
// loop took in between.
import { createReadStream, existsSync } from 'node:fs';
import { createServer } from 'node:http';
import { extname, join, normalize } from 'node:path';
import { chromium } from '@playwright/test';
import { systemChromium } from '../e2e/chromium.mjs';

const BURSTS = 9;
const FRAMES = 30; // of a burst
const TYPES = {
  '.html': 'text/html',
  '.js': 'text/javascript',
  '.css': 'text/css',
  '.wasm': 'application/wasm',
  '.svg': 'image/svg+xml',
  '.json': 'application/json',
};

/** Serves the built page alone: posing needs no server. */
async function servePage(folder) {
  const server = createServer((request, response) => {
    const path = join(folder, normalize(new URL(request.url, 'http://page').pathname).replace(/\/$/, '/index.html'));
    if (!existsSync(path)) return response.writeHead(404).end();
    response.writeHead(200, { 'content-type': TYPES[extname(path)] ?? 'application/octet-stream' });
    createReadStream(path).pipe(response);
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  return server;
}

async function openProject(page, file) {
  const dialog = page.waitForEvent('filechooser');
  await page.getByRole('button', { name: 'Open', exact: true }).click();
  await (await dialog).setFiles(file);
  await page.getByRole('button', { name: 'Reset the whole pose' }).waitFor();
  await page.locator('#fore path').first().waitFor({ state: 'attached' });
}

/** Moves the jaw slider once a frame, as a drag does. */
function poseMouth(page) {
  return page.evaluate(async (frames) => {
    const jaw = document.querySelector('input[type=range][aria-label^="Jaw"]');
    for (let frame = 0; frame < frames; frame += 1) {
      jaw.value = String(0.3 + 0.25 * Math.sin(frame / 4));
      jaw.dispatchEvent(new Event('input', { bubbles: true }));
      await new Promise(requestAnimationFrame);
    }
  }, FRAMES);
}

/** Attribute writes of a frame of `poseMouth`, by element; counted apart, since counting costs. */
async function writesPerFrame(page) {
  await page.evaluate(() => {
    window.writes = { path: 0, linearGradient: 0, other: 0 };
    window.observer = new MutationObserver((records) => {
      for (const { target } of records) {
        const isPicture = target.closest('#back, #fore, #local, defs');
        window.writes[isPicture && target.localName in window.writes ? target.localName : 'other'] += 1;
      }
    });
    window.observer.observe(document.body, { attributes: true, subtree: true });
  });
  await poseMouth(page);
  const writes = await page.evaluate(() => {
    window.observer.disconnect();
    return window.writes;
  });
  return Object.fromEntries(Object.entries(writes).map(([name, count]) => [name, Math.round(count / FRAMES)]));
}

/** Twenty million steps of a linear congruential generator. */
function fixedLoop(page) {
  return page.evaluate(() => {
    let x = 1;
    for (let step = 0; step < 2e7; step += 1) x = (x * 1103515245 + 12345) & 0x7fffffff;
    return x;
  });
}

/** CPU milliseconds of the main thread that `work` costs, in all and by phase. */
async function cost(session, work) {
  const read = async () => new Map((await session.send('Performance.getMetrics')).metrics.map(({ name, value }) => [name, 1000 * value]));
  const before = await read();
  await work();
  const after = await read();
  const spent = (name) => after.get(name) - before.get(name);
  return {
    all: spent('ThreadTime'),
    script: spent('ScriptDuration'),
    style: spent('RecalcStyleDuration'),
    layout: spent('LayoutDuration'),
  };
}

const sorted = (values) => [...values].sort((a, b) => a - b);
const median = (values) => sorted(values)[values.length >> 1].toFixed(1);

const [project, folder = join(import.meta.dirname, '../../web/dist')] = process.argv.slice(2);
if (!project) throw new Error('Usage: node tests/bench/frame_cost.mjs PROJECT.vtalk [DIST]');
const server = await servePage(folder);
const browser = await chromium.launch(systemChromium());
const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
await page.goto(`http://127.0.0.1:${server.address().port}/`);
await openProject(page, project);
const writes = await writesPerFrame(page); // warms up, too
const session = await page.context().newCDPSession(page);
await session.send('Performance.enable', { timeDomain: 'threadTicks' });
const loops = [];
const bursts = [];
for (let burst = 0; burst < BURSTS; burst += 1) {
  loops.push((await cost(session, () => fixedLoop(page))).all);
  bursts.push(await cost(session, () => poseMouth(page)));
}
const perFrame = (phase) => bursts.map((burst) => burst[phase] / FRAMES);
const all = sorted(perFrame('all'));
const paths = await page.locator('#back path, #fore path, #local path').count();
console.log(`${paths} paths; a frame writes ${writes.path} paths, ${writes.linearGradient} gradients, ${writes.other} other attributes`);
console.log(`main thread: median ${median(all)} CPU ms a frame, ${all[0].toFixed(1)} to ${all.at(-1).toFixed(1)} over ${BURSTS} bursts`);
console.log(`of which script ${median(perFrame('script'))}, style ${median(perFrame('style'))}, layout ${median(perFrame('layout'))}`);
console.log(`fixed loop: median ${median(loops)} CPU ms, ${sorted(loops)[0].toFixed(1)} at best`);
await browser.close();
server.close();
