// CPU milliseconds of the main thread per animation frame while a mouth pose is dragged, from a Chromium trace.
// Usage: node tests/bench/frame_cost.mjs PROJECT.vtalk   (after `npm run build`; software raster, so read it as an upper bound)
import { createReadStream, existsSync } from 'node:fs';
import { createServer } from 'node:http';
import { extname, join, normalize } from 'node:path';
import { chromium } from '@playwright/test';
import { systemChromium } from '../e2e/chromium.mjs';

const DIST = join(import.meta.dirname, '../../web/dist');
const FRAMES = 150;
const TYPES = {
  '.html': 'text/html',
  '.js': 'text/javascript',
  '.css': 'text/css',
  '.wasm': 'application/wasm',
  '.svg': 'image/svg+xml',
  '.json': 'application/json',
};

/** Serves the built page alone: posing needs no server. */
async function servePage() {
  const server = createServer((request, response) => {
    const path = join(DIST, normalize(new URL(request.url, 'http://page').pathname).replace(/\/$/, '/index.html'));
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
}

/** Moves the jaw slider once a frame, as a drag does; returns how many paths changed per frame. */
function poseMouth(page) {
  return page.evaluate(async (frames) => {
    const jaw = document.querySelector('input[type=range][aria-label^="Jaw"]');
    const paths = document.querySelectorAll('#back path, #fore path, #local path');
    let writes = 0;
    const observer = new MutationObserver((records) => {
      writes += records.length;
    });
    for (const path of paths) observer.observe(path, { attributes: true, attributeFilter: ['d'] });
    performance.mark('pose-start');
    for (let frame = 0; frame < frames; frame += 1) {
      jaw.value = String(0.3 + 0.25 * Math.sin(frame / 4));
      jaw.dispatchEvent(new Event('input', { bubbles: true }));
      await new Promise(requestAnimationFrame);
    }
    performance.mark('pose-end');
    await new Promise(requestAnimationFrame);
    observer.disconnect();
    return { paths: paths.length, written: writes / frames };
  }, FRAMES);
}

/** Thread CPU time of the renderer's main thread between the marks, per frame. */
function mainThreadMilliseconds(trace) {
  const events = trace.traceEvents;
  const mark = (name) => events.find((event) => event.name === name && event.cat.includes('blink.user_timing'));
  const [start, end] = [mark('pose-start'), mark('pose-end')];
  const isTask = (event) =>
    event.name === 'ThreadControllerImpl::RunTask' && event.pid === start.pid && event.tid === start.tid && event.ph === 'X';
  const within = events.filter((event) => isTask(event) && event.ts >= start.ts && event.ts <= end.ts);
  return within.reduce((sum, event) => sum + (event.tdur ?? 0), 0) / 1000 / FRAMES;
}

const [project] = process.argv.slice(2);
if (!project) throw new Error('Usage: node tests/bench/frame_cost.mjs PROJECT.vtalk');
const server = await servePage();
const browser = await chromium.launch(systemChromium());
const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
await page.goto(`http://127.0.0.1:${server.address().port}/`);
await openProject(page, project);
await poseMouth(page); // warm up
await browser.startTracing(page, { categories: ['toplevel', 'blink.user_timing', 'devtools.timeline'] });
const { paths, written } = await poseMouth(page);
const trace = JSON.parse((await browser.stopTracing()).toString());
console.log(
  `${paths} paths, ${written.toFixed(0)} written a frame, main thread ${mainThreadMilliseconds(trace).toFixed(1)} CPU ms a frame over ${FRAMES} frames`,
);
await browser.close();
server.close();
