// Reloads the editor at random moments, while a portrait is edited and while one is traced: no edit is lost, none waits for ever.
// Usage: node scripts/soak/reload.mjs [EDITS] [TRACINGS] [SEED]   (after `npm run build`)
// What the page has shown as changed must be there after the reload; a tracing must end in a picture without a sign of progress.
import { chromium } from '@playwright/test';
import { systemChromium } from '../../tests/e2e/chromium.mjs';
import { serveEditor } from '../../tests/e2e/serving.mjs';

const [edits, tracings, seed] = [40, 12, 1].map((usual, index) => Number(process.argv[index + 2] ?? usual));
const TRACING_LIMIT = 300_000; // milliseconds; the machine may be busy
const SHOWN_LIMIT = 60_000;
const LATEST_EDIT_RELOAD = 400; // milliseconds after the change was shown; the editor gathers changes before it writes them
const LATEST_TRACING_RELOAD = 8000; // milliseconds after the picture was chosen

/** Numbers in [0, 1), the same every time (mulberry32). */
function randomNumbers(from) {
  let state = from;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let mixed = Math.imul(state ^ (state >>> 15), 1 | state);
    mixed = (mixed + Math.imul(mixed ^ (mixed >>> 7), 61 | mixed)) ^ mixed;
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 2 ** 32;
  };
}

const random = randomNumbers(seed);
const jaw = (page) => page.getByRole('spinbutton', { name: 'Jaw, value' });
const name = (page) => page.getByRole('textbox', { name: 'Name of the portrait' });
const progress = (page) => page.getByRole('region', { name: 'Progress' });
const picture = (page) => page.locator('#fore');
const sample = (page) => page.getByRole('region', { name: 'Samples' }).getByRole('button').first();

/** Once, or twice in quick succession as an impatient person does. */
async function reload(page) {
  if (random() < 0.3) {
    await page.reload({ waitUntil: 'commit' });
    await page.waitForTimeout(300 * random());
  }
  await page.reload();
}

async function shows(field, expected) {
  const deadline = Date.now() + SHOWN_LIMIT;
  while ((await field.inputValue({ timeout: SHOWN_LIMIT })) !== expected) {
    if (Date.now() > deadline) throw new Error(`${await field.inputValue()} is shown instead of ${expected}`);
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
}

/** Some changes of pose and name, then a reload; both must be what they were. */
async function editAndReload(page, round) {
  const kept = { jaw: await jaw(page).inputValue(), name: await name(page).inputValue() };
  for (let change = Math.ceil(3 * random()); change > 0; change -= 1) {
    const [field, key, value] =
      random() < 0.6 ? [jaw(page), 'jaw', random().toFixed(2)] : [name(page), 'name', `Round ${round}, change ${change}`];
    await field.fill(value);
    await field.press('Enter');
    await shows(field, value);
    kept[key] = value;
  }
  await page.waitForTimeout(LATEST_EDIT_RELOAD * random() ** 2);
  await reload(page);
  await shows(jaw(page), kept.jaw);
  await shows(name(page), kept.name);
}

/** A sample is chosen and the page reloaded while it is uploaded, waits or is traced; says what was there afterwards. */
async function traceAndReload(page, url) {
  await page.goto(url);
  await page.getByRole('radio', { name: 'Draft' }).check();
  await sample(page).click();
  const delay = LATEST_TRACING_RELOAD * random() ** 2;
  await page.waitForTimeout(delay);
  await reload(page);
  await picture(page).or(sample(page)).first().waitFor({ timeout: TRACING_LIMIT });
  if (await sample(page).isVisible()) return `chosen again (${Math.round(delay)} ms)`;
  await progress(page).waitFor({ state: 'hidden', timeout: TRACING_LIMIT });
  await page.getByRole('button', { name: 'Save' }).isEnabled();
  return 'traced';
}

const { url, stop } = await serveEditor();
const browser = await chromium.launch(systemChromium());
const failed = [];
try {
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 } });
  const page = await context.newPage();
  page.on('pageerror', (error) => failed.push(`${error}`));
  const outcomes = [];
  for (let round = 1; round <= tracings; round += 1) {
    const fresh = await browser.newContext({ viewport: { width: 1280, height: 800 } });
    const tracing = await fresh.newPage();
    tracing.on('pageerror', (error) => failed.push(`${error}`));
    outcomes.push(await traceAndReload(tracing, url).catch((error) => failed.push(`tracing ${round}: ${error.message}`) && 'failed'));
    console.log(`tracing ${round}: ${outcomes.at(-1)}`);
    await fresh.close();
  }
  await page.goto(url);
  await page.getByRole('radio', { name: 'Draft' }).check();
  await sample(page).click();
  await progress(page).waitFor({ timeout: SHOWN_LIMIT });
  await progress(page).waitFor({ state: 'hidden', timeout: TRACING_LIMIT });
  for (let round = 1; round <= edits; round += 1) {
    await editAndReload(page, round).catch((error) => failed.push(`edit ${round}: ${error.message}`));
  }
  const traced = outcomes.filter((outcome) => outcome === 'traced').length;
  console.log(`reload: ${edits} rounds of edits; ${tracings} tracings, ${traced} of them traced to the end; ${failed.length} failed`);
} finally {
  await browser.close();
  stop();
}
for (const line of failed) console.log(`reload: ${line}`);
process.exitCode = failed.length > 0 ? 1 : 0;
