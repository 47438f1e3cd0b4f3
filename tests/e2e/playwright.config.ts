import { mkdtempSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { defineConfig } from '@playwright/test';
import { systemChromium } from './chromium.mjs';

const PORT = Number(process.env.VECTORTALKER_E2E_PORT ?? 8317);
const ROOT = join(import.meta.dirname, '../..');
// The config is loaded by every worker; only the first makes the folder.
process.env.VECTORTALKER_E2E_DATA ??= mkdtempSync(join(tmpdir(), 'vectortalker-e2e-'));

export default defineConfig({
  testDir: import.meta.dirname,
  outputDir: join(ROOT, 'test-results'),
  workers: 1, // the server's optimiser takes the other core
  timeout: 300_000, // a busy machine is no failure
  expect: { timeout: 20_000 },
  reporter: 'list',
  use: {
    baseURL: `http://127.0.0.1:${PORT}`,
    viewport: { width: 1280, height: 800 },
    trace: 'retain-on-failure',
    launchOptions: systemChromium(),
  },
  webServer: {
    command: `${join(ROOT, '.venv/bin/vectortalker')} serve --port ${PORT} --data ${process.env.VECTORTALKER_E2E_DATA}`,
    url: `http://127.0.0.1:${PORT}/api/health`,
    gracefulShutdown: { signal: 'SIGTERM', timeout: 5000 },
    timeout: 60_000,
  },
});
