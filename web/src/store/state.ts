/** The editor's whole state. Only the actions beside it write these signals; everything that can be computed is computed. */
import { computed, signal } from '@preact/signals';
import type { Connection } from '../api/events';
import type { Faces, JobState, Landmarks, Scene, VectorizeOptions } from '../api/schema';
import type { Xy } from '../face/vector';
import { type Edit, editOf } from './edit';
import { type History, historyOf } from './history';

/** The picture being worked on, at the size of the normalised portrait. */
export type PortraitPicture = {
  /** The server's name for it; null after opening a project file. */
  readonly id: string | null;
  readonly name: string;
  readonly width: number;
  readonly height: number;
  readonly picture: Blob | null;
  readonly notices: readonly string[];
};

/** Left eye, right eye, nose tip, left and right mouth corner, in portrait pixels. */
export type Pins = readonly [Xy, Xy, Xy, Xy, Xy];

/** A sound that tracks of the project speak with, under its file name in the project. */
export type Clip = {
  /** The server's name for it; null until it is sent. */
  readonly id: string | null;
  readonly name: string;
  readonly data: Blob;
};

/** Behind the first screen may wait what a portrait that was left goes on with. */
export type Session = { readonly kind: 'welcome'; readonly behind: Workplace | null } | Workplace;

/** `before` stays until the server has taken the picture: it may refuse it. */
export type Uploading = { readonly kind: 'uploading'; readonly name: string; readonly picture: Blob; readonly before: Session };

export type Workplace = Uploading | Opened;

export type Opened =
  | { readonly kind: 'finding' }
  | { readonly kind: 'choosing'; readonly faces: Faces }
  | { readonly kind: 'pinning'; readonly pins: Pins; readonly noFaceFound: boolean }
  | { readonly kind: 'editing' };

/** A portrait with all the work on it. */
export type PortraitWork = {
  readonly session: Opened;
  readonly portrait: PortraitPicture | null;
  readonly scene: Scene | null;
  readonly history: History<Edit>;
  readonly job: { readonly state: JobState | null; readonly landmarks: Landmarks | null };
  readonly clips: readonly Clip[];
};

/** Portraits that gave way to another one, in the order they were opened: those before the one on the stage, and those after it. */
export type Replaced = { readonly before: readonly PortraitWork[]; readonly after: readonly PortraitWork[] };

export type ToolName = 'pose' | 'rest' | 'pan' | 'zoom';
export type Theme = 'system' | 'light' | 'dark';

export type Notice = {
  readonly kind: 'error' | 'advice' | 'done';
  readonly text: string;
  readonly action?: { readonly label: string; readonly run: () => void };
};

export const session = signal<Session>({ kind: 'welcome', behind: null });
export const portrait = signal<PortraitPicture | null>(null);
export const scene = signal<Scene | null>(null);
export const history = signal<History<Edit>>(historyOf(editOf('Untitled', null)));
/** What a drag or a moving slider shows; it becomes one step of the history when it is let go. */
export const draft = signal<Edit | null>(null);
export const edit = computed(() => draft.value ?? history.value.present);

export const preset = signal<VectorizeOptions['preset']>('standard');
export const job = signal<JobState | null>(null);
export const connection = signal<Connection | null>(null);
/** Kept beside the history, so that steps hold names of sounds and no sounds. */
export const clips = signal<readonly Clip[]>([]);
/** The landmarks that the scene was drawn for; differ from the edit's after a correction. */
export const tracedLandmarks = signal<Landmarks | null>(null);

export const replaced = signal<Replaced>({ before: [], after: [] });

export const tool = signal<ToolName>('pose');
/** Falloff of a drag, in outer-eye distances. */
export const softRadius = signal(0.35);
export const singlePoint = signal(false);
export const mirrored = signal(false);
export const landmarksShown = signal(true);
export const meshShown = signal(false);
export const ghostShown = signal(false);
export const comparing = signal(false);

export const playing = signal(false);
export const looping = signal(true);
/** Whether what is said is written on the stage while it is. */
export const captionsShown = signal(true);
/** The playhead; 0 is the start of the track. */
export const timeSeconds = signal(0);

export const panel = signal<'layers' | 'pose' | 'speech'>('pose');
/** On narrow screens: only the tabs of the panel are there. */
export const panelFolded = signal(false);
export const shortcutsShown = signal(false);
export const notice = signal<Notice | null>(null);
/** Read out by screen readers. */
export const announcement = signal('');
export const theme = signal<Theme>('system');

/** Parts of the document, so that a drag redraws only what shows what it changes. */
export const documentName = computed(() => edit.value.name);
export const openedTracks = computed(() => edit.value.tracks);
export const track = computed(() => openedTracks.value[0] ?? null);
/** Whether there is a picture on the stage whose landmarks can be moved. */
export const canPose = computed(() => session.value.kind === 'editing' && edit.value.landmarks !== null);
