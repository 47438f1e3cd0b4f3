/** A model with many portraits: whatever gave way comes back with its own steps, in order. */
import { beforeEach, expect, test } from 'vitest';
import { editOf } from './edit';
import { commit, historyOf } from './history';
import { bringBack, bringForward, bringNearest, putAside } from './replacing';
import { clearStage, putOnStage } from './stage';
import { history, type PortraitWork, portrait, replaced, session } from './state';

const named = (name: string): PortraitWork => ({
  session: { kind: 'editing' },
  portrait: { id: null, name, width: 4, height: 3, picture: null, notices: [] },
  scene: null,
  history: commit(historyOf(editOf(name, null)), editOf(`${name}, edited`, null)),
  job: { state: null, landmarks: null },
  clips: [],
});

function open(name: string): void {
  putAside();
  clearStage();
  putOnStage(named(name));
}

const onStage = () => portrait.value?.name;
const names = (works: readonly PortraitWork[]) => works.map((work) => work.portrait?.name);

beforeEach(() => {
  clearStage();
  session.value = { kind: 'welcome', behind: null };
  replaced.value = { before: [], after: [] };
});

test('a portrait that gave way comes back with its steps, and the other one after it', () => {
  open('A');
  open('B');
  expect(bringBack()?.portrait?.name).toBe('A');
  expect(history.value.past).toEqual([editOf('A', null)]);
  expect(bringBack()).toBeNull();
  expect(onStage()).toBe('A');
  bringForward();
  expect(onStage()).toBe('B');
  expect(bringForward()).toBeNull();
});

test('a portrait opened in between loses none of the others', () => {
  for (const name of ['A', 'B']) open(name);
  bringBack();
  open('C');
  expect([names(replaced.value.before), onStage(), names(replaced.value.after)]).toEqual([['A'], 'C', ['B']]);
});

test('giving way is a step: what was undone before it is forgotten', () => {
  open('A');
  history.value = { past: [], present: editOf('A', null), future: [editOf('undone', null)] };
  open('B');
  bringBack();
  expect(history.value.future).toEqual([]);
});

test('what waits behind the first screen gives way, too; nothing does where there is nothing', () => {
  open('A');
  session.value = { kind: 'welcome', behind: { kind: 'editing' } };
  open('B');
  expect(names(replaced.value.before)).toEqual(['A']);
  clearStage();
  expect(putAside()).toBeNull();
});

test('an emptied stage is filled by the portrait before it, else by the one after', () => {
  for (const name of ['A', 'B', 'C']) open(name);
  bringBack();
  clearStage();
  expect(bringNearest()?.portrait?.name).toBe('A');
  clearStage();
  expect(bringNearest()?.portrait?.name).toBe('C');
  clearStage();
  expect(bringNearest()).toBeNull();
});

test('twelve portraits are kept, the earliest are let go', () => {
  for (let number = 0; number < 20; number += 1) open(`${number}`);
  expect(names(replaced.value.before)).toEqual(Array.from({ length: 12 }, (_, k) => `${k + 7}`));
});
