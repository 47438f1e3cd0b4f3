import { strToU8, zipSync } from 'fflate';
import { describe, expect, it } from 'vitest';
import type { Project, Track } from '../api/schema';
import { pack, unpack } from './vtalk';

const SQUARE = [0, 0, 1, 0, 2, 0, 3, 0, 3, 1, 3, 2, 3, 3, 2, 3, 1, 3, 0, 3, 0, 2, 0, 1];

const PROJECT: Project = {
  schema_version: 1,
  name: 'Ada',
  scene: {
    width: 4,
    height: 4,
    canvas: '#ffffff',
    back: [],
    fore: [{ points: SQUARE, fill: { kind: 'solid', colour: '#102030', opacity: 0.5 } }],
    local: [],
  },
  landmarks: null,
  pose: { articulators: { jaw: 0.4 }, offsets: null },
  tracks: [{ schema_version: 1, name: 'hum', duration: 1, fps: 25, articulators: { jaw: [0, 0.2] } }],
  settings: { fore_opacity: 0.5, back_visible: false },
  source: 'source.png',
};

const zipOf = (document: unknown) => zipSync({ 'project.json': strToU8(JSON.stringify(document)), 'source.png': new Uint8Array(1) });

describe('a .vtalk file', () => {
  it('comes back as it was saved, with its picture', async () => {
    const source = new Uint8Array([137, 80, 78, 71]);
    const file = await unpack(await pack({ project: PROJECT, source, sounds: new Map() }), 'ada.vtalk');
    expect(file.project).toMatchObject(PROJECT);
    expect(file.source).toEqual(source);
    expect(file.sounds.size).toBe(0);
  });

  it('has the same bytes for the same project', async () => {
    const file = { project: PROJECT, source: new Uint8Array(9), sounds: new Map() };
    expect(await pack(file)).toEqual(await pack(file));
  });

  it('holds the sound of every track that speaks, that on the timeline as the project’s own', async () => {
    const speaking = (audio: string): Track => ({ ...PROJECT.tracks[0], name: audio, audio }) as Track; // tracks carry more than the schema names
    const project = {
      ...PROJECT,
      audio: 'speech-a.wav',
      tracks: [speaking('speech-a.wav'), speaking('speech-b.wav'), speaking('gone.wav')],
    };
    const sounds = new Map([
      ['speech-a.wav', new Uint8Array([1])],
      ['speech-b.wav', new Uint8Array([2, 3])],
    ]);
    const file = await unpack(await pack({ project, source: new Uint8Array(1), sounds }), 'ada.vtalk');
    expect(file.sounds).toEqual(sounds);
    expect(file.project.tracks[1]).toMatchObject({ audio: 'speech-b.wav' });
  });

  it('fills in what may be left out', async () => {
    const { project } = await unpack(zipOf({ schema_version: 1, name: 'Ada', scene: PROJECT.scene }), 'a.vtalk');
    expect(project).toMatchObject({ landmarks: null, pose: { articulators: {}, offsets: null }, tracks: [], settings: {} });
  });

  it.each([
    ['a newer version', { ...PROJECT, schema_version: 2 }, 'saved by a newer VectorTalker'],
    ['a scene without size', { ...PROJECT, scene: { ...PROJECT.scene, width: 0 } }, 'the size of the scene'],
    ['a path that is no chain of cubics', { ...PROJECT, scene: { ...PROJECT.scene, fore: [{ points: [1, 2], fill: {} }] } }, 'layer fore'],
    ['a picture that is not there', { ...PROJECT, source: 'other.png' }, 'holds no other.png'],
  ])('is refused with %s', async (_, document, message) => {
    await expect(unpack(zipOf(document), 'a.vtalk')).rejects.toThrow(message);
  });

  it('is refused when it is no zip', async () => {
    await expect(unpack(strToU8('hello'), 'a.vtalk')).rejects.toThrow('not a whole project file');
  });
});
