import { describe, expect, it } from 'vitest';
import { commit, historyOf, redo, undo } from './history';

describe('history', () => {
  it('undoes to the first document at any depth and redoes to the last', () => {
    const steps = Array.from({ length: 1000 }, (_, index) => `step ${index}`);
    const done = steps.reduce(commit, historyOf('start'));
    const undone = steps.reduce((history) => undo(history), done);
    expect(undone.present).toBe('start');
    expect(steps.reduce((history) => redo(history), undone)).toEqual(done);
  });

  it('forgets what was undone once something else is done', () => {
    const history = commit(undo(commit(historyOf('a'), 'b')), 'c');
    expect(redo(history).present).toBe('c');
    expect(undo(history).present).toBe('a');
  });

  it('does not count the same document as a step', () => {
    const document = { name: 'portrait' };
    expect(commit(historyOf(document), document).past).toEqual([]);
  });

  it('stays where it is when there is nothing to undo or redo', () => {
    const history = historyOf('only');
    expect(undo(history)).toBe(history);
    expect(redo(history)).toBe(history);
  });
});
