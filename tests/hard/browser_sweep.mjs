// Every file of the hard set, dropped into the editor; writes the column "browser" of the tables in docs/robustness.md.
// Usage: node tests/hard/browser_sweep.mjs [NAME…]   (after `npm run build` and `tests/hard/sweep.py`; files of the development data)
// A file ends well with a picture, or with one sentence that says why there is none.
import { readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { chromium } from '@playwright/test';
import { systemChromium } from '../e2e/chromium.mjs';
import { serveEditor } from '../e2e/serving.mjs';

const ROOT = join(import.meta.dirname, '../..');
const FOLDER = join(process.env.VECTORTALKER_SHARED ?? join(ROOT, '../shared'), 'data/hard');
const TABLES = join(ROOT, 'docs/robustness.md');
const COLUMN = 'browser';
const LIMIT = 240_000; // milliseconds until a question, a message or a picture; the machine may be busy

const question = (page) => page.getByRole('group', { name: 'Which face should talk?' });
const pins = (page) => page.getByRole('region', { name: 'Five pins' });
const alert = (page) => page.getByRole('alert');
const picture = (page) => page.locator('#fore');

/** Drops the file onto the page as a person does. */
async function drop(page, name, data) {
  const transfer = await page.evaluateHandle(
    ([base64, fileName]) => {
      const bytes = Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
      const files = new DataTransfer();
      files.items.add(new File([bytes], fileName));
      return files;
    },
    [data.toString('base64'), name],
  );
  await page.dispatchEvent('body', 'drop', { dataTransfer: transfer });
}

/** What the page shows next: a message, a question or a picture. */
async function next(page) {
  const shown = alert(page).or(pins(page)).or(question(page)).or(picture(page)).first();
  await shown.waitFor({ state: 'attached', timeout: LIMIT });
  for (const [kind, locator] of Object.entries({ alert, pins, question })) if ((await locator(page).count()) > 0) return kind;
  return 'picture';
}

/** Answers what the page asks, waits for the first picture and keeps it; says how that went. */
async function outcome(page) {
  switch (await next(page)) {
    case 'alert':
      return (await alert(page).locator('p').innerText()).trim();
    case 'pins':
      await page.getByRole('button', { name: /^Use anyway/ }).click();
      return `no face: five pins offered; without them ${await traced(page)}`;
    case 'question': {
      const faces = await question(page).getByRole('button').count();
      await question(page).getByRole('button').first().click();
      return `${faces} faces offered; ${await traced(page)}`;
    }
    default:
      return traced(page);
  }
}

async function traced(page) {
  await alert(page).or(picture(page)).first().waitFor({ state: 'attached', timeout: LIMIT });
  if ((await alert(page).count()) > 0) return (await alert(page).locator('p').innerText()).trim();
  const enough = page.getByRole('button', { name: 'Good enough' });
  const progress = page.getByRole('region', { name: 'Progress' });
  await enough.or(page.locator('body:not(:has(.progress))')).first().waitFor({ state: 'attached' });
  if (await enough.isVisible()) await enough.click();
  await progress.waitFor({ state: 'hidden', timeout: LIMIT });
  const advised = (await page.getByText('Check the landmarks').count()) > 0 ? ', landmarks to be checked' : '';
  return `traced${advised}`;
}

async function sweep(browser, url, name) {
  const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
  const faults = [];
  page.on('pageerror', (error) => faults.push(`${error}`));
  await page.goto(url);
  await page.getByRole('radio', { name: 'Draft' }).check();
  await drop(page, name, readFileSync(join(FOLDER, name)));
  const text = await outcome(page).catch((error) => `FAILED: ${error.message.split('\n')[0]}`);
  await page.close();
  return faults.length > 0 ? `FAILED: ${faults[0]}` : text;
}

/** The tables with `COLUMN` filled in: a cell for each row whose first cell is a file name, "the same" where the message is. */
function withColumn(markdown, outcomes) {
  let at = -1;
  return markdown
    .split('\n')
    .map((line) => {
      if (!line.startsWith('| ') && !line.startsWith('|-')) return line;
      const cells = line.slice(1, -1).split(/(?<!\\)\|/);
      if (cells[0].trim() === 'file') at = cells.findIndex((cell) => cell.trim() === COLUMN);
      const text = cellOf(cells, outcomes);
      if (at < 0) return `|${[...cells, text].join('|')}|`;
      return `|${cells.map((cell, index) => (index === at && text.trim() !== '' ? text : cell)).join('|')}|`;
    })
    .join('\n');
}

function cellOf(cells, outcomes) {
  const name = cells[0].trim();
  if (name === 'file') return ` ${COLUMN} `;
  if (/^-+$/.test(name)) return '---';
  const text = outcomes.get(name)?.replaceAll('|', '\\|') ?? '';
  return cells.some((cell) => cell.trim() === text) ? ' the same ' : ` ${text} `;
}

const wanted = process.argv.slice(2);
const { url, stop } = await serveEditor();
const browser = await chromium.launch(systemChromium());
const outcomes = new Map();
try {
  for (const name of readdirSync(FOLDER).sort()) {
    if (wanted.length > 0 && !wanted.some((part) => name.includes(part))) continue;
    outcomes.set(name, await sweep(browser, url, name));
    console.log(`${name}: ${outcomes.get(name)}`);
  }
} finally {
  await browser.close();
  stop();
}
writeFileSync(TABLES, withColumn(readFileSync(TABLES, 'utf8'), outcomes));
process.exitCode = [...outcomes.values()].some((text) => text.startsWith('FAILED')) ? 1 : 0;
