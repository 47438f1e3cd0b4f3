// Generated from openapi.json by `npm run gen`; never edited by hand.

/** What the server answers instead of a value; `message` is one sentence for the user. */
export type ApiError = {
  code: 'bad_picture' | 'picture_too_large' | 'bad_option' | 'bad_landmarks' | 'bad_project' | 'bad_track' | 'bad_audio' | 'not_found' | 'queue_full' | 'storage_full' | 'unsupported' | 'unauthorised' | 'unavailable' | 'cancelled' | 'bad_request' | 'internal';
  message: string;
};

export type Body_add_portrait = {
  file: string;
};

export type Body_add_recording = {
  file: string;
};

export type Body_import_track = {
  file: string;
};

export type Box = {
  x: number;
  y: number;
  width: number;
  height: number;
};

export type Face = {
  box: Box;
  landmarks: Landmarks;
  confidence: number;
  fit_advised: boolean;
};

/** Detected faces, largest first. Empty: no face was found, the user fits five pins. */
export type Faces = {
  width: number;
  height: number;
  faces: Face[];
};

/** `workers` counts the worker processes that have loaded everything, `queued` and `running` the jobs. */
export type Health = {
  version: string;
  workers: number;
  queued: number;
  running: number;
  store: 'sqlite' | 'redis';
  free_bytes: number | null;
  limits: Limits;
};

export type Iris = {
  centre: [number, number];
  radius: number;
};

/** Landmarks None: no face; the picture becomes back and fore only as far as segmentation finds a person.
 *
 * `find_face`: without landmarks, the largest face that is detected. */
export type JobRequest = {
  portrait_id: string;
  landmarks?: Landmarks | null;
  find_face: boolean;
  options: VectorizeOptions;
};

/** Whole snapshot of a job, the only thing SSE ever sends. `revision` grows with each that is stored.
 *
 * `scene_revision` names the latest scene at `/api/jobs/{id}/scene`; 0: none yet. `estimate_s`: seconds until the job
 * is done, its wait included, going by recent jobs of its kind. */
export type JobState = {
  id: string;
  revision: number;
  phase: 'queued' | 'running' | 'done' | 'failed' | 'cancelled';
  stage: string;
  level: number;
  levels: number;
  n_paths: number;
  progress: number;
  elapsed_seconds: number;
  remaining_seconds: number | null;
  queue_position: number | null;
  estimate_s?: number | null;
  scene_revision: number;
  metrics?: Metrics | null;
  error?: ApiError | null;
};

/** 68 iBUG points; irises image-left first; `depth` towards the viewer in units of the outer-eye distance. */
export type Landmarks = {
  points: [number, number][];
  irises?: [Iris, Iris] | null;
  depth?: number[] | null;
};

/** What the server allows, for clients that want to know before they are refused. */
export type Limits = {
  body_bytes: number;
  queued_jobs: number;
  active_jobs: number;
  retention_hours: number;
};

/** Linear gradient from `start` to `end`, its stops evenly spaced: padded, unpremultiplied sRGB. */
export type LinearFill = {
  kind: 'linear';
  start: [number, number];
  end: [number, number];
  stops: Stop[];
};

export type LocalPath = {
  points: number[];
  fill: SolidFill | LinearFill;
  part: 'left_eye' | 'right_eye' | 'left_iris' | 'right_iris' | 'mouth_cavity' | 'mouth_lower' | 'tongue' | 'mouth_upper';
};

/** Scores of a resvg rendering of the written SVG against the canonical image (docs/benchmarks.md). */
export type Metrics = {
  paths: number;
  segments: number;
  parameters: number;
  iterations: number;
  seconds: number;
  cpu_seconds: number;
  bytes: number;
  gzip_bytes: number;
  mse: number;
  psnr: number;
  ssim: number;
};

export type Portrait = {
  id: string;
  name: string;
  width: number;
  height: number;
  notices: string[];
};

/** Articulators and landmark offsets (units of the outer-eye distance, from rest); both add up. */
export type Pose = {
  articulators: { [key: string]: number };
  offsets?: [number, number][] | null;
};

/** `project.json` of a `.vtalk` file. The source picture and the audio lie beside it in the zip. */
export type Project = {
  schema_version: 1;
  name: string;
  scene: Scene;
  landmarks: Landmarks | null;
  pose: Pose;
  tracks: Track[];
  settings: { [key: string]: string | number | boolean };
  source?: string | null;
  audio?: string | null;
};

/** A sound that was uploaded or spoken. `envelope`: its peak in 0…1, 50 a second. */
export type Recording = {
  id: string;
  name: string;
  duration: number;
  media_type: string;
  envelope: number[];
};

/** Layered portrait in painter's order. `canvas` fills the whole frame beneath `back`. */
export type Scene = {
  width: number;
  height: number;
  canvas: string;
  back: ScenePath[];
  fore: ScenePath[];
  local: LocalPath[];
};

/** Closed chain of cubics: flat x, y of `anchor, handle, handle` a segment; the last ends at the first anchor. */
export type ScenePath = {
  points: number[];
  fill: SolidFill | LinearFill;
};

export type SolidFill = {
  kind: 'solid';
  colour: string;
  opacity: number;
};

/** Seconds from the beginning of a recording. */
export type Span = {
  start: number;
  end: number;
};

/** `language` is the transcript's. `gains` by channel or group (mouth, blink, head, brows); 0 mutes. */
export type SpeechOptions = {
  language: string;
  style: 'subtle' | 'normal' | 'cartoon';
  amplitude: number;
  smoothing: number;
  seed: number;
  gains: { [key: string]: number };
};

/** Listen to a recording, with its transcript if there is one. With `part`: only to that, keeping the `visemes` that
 * are given outside it; the transcript is then that of the part. */
export type SpeechRequest = {
  recording_id: string;
  transcript?: string | null;
  options: SpeechOptions;
  part?: Span | null;
  visemes?: VisemeBlock[] | null;
};

/** What was heard. `loudness` (nats, 50 a second) moves head and brows when the track is made anew. */
export type SpeechResult = {
  track: Track;
  visemes: VisemeBlock[];
  loudness: number[];
  tier: 'audio' | 'transcript';
};

/** A text for espeak-ng to speak; `voice` is a variant such as f3, `pitch` 50 its usual one. */
export type SpokenRequest = {
  text: string;
  language: string;
  voice: string;
  rate: number;
  pitch: number;
};

export type Stop = {
  colour: string;
  opacity: number;
};

/** Poses over time. `landmarks`: offsets from a neutral face (closed lips, open eyes); either or both are given. */
export type Track = {
  schema_version: 1;
  name: string;
  duration: number;
  fps: number;
  landmarks?: [number, number][][] | null;
  articulators?: { [key: string]: number[] } | null;
};

/** A track for another program: mouth cues of Rhubarb from its `visemes`, or rows of 68 points of a neutral face. */
export type TrackExportRequest = {
  track: Track;
  format: 'json' | 'rhubarb-tsv' | 'rhubarb-json' | 'csv';
};

/** Options of `vectortalker vectorize`; None means: what the preset says. */
export type VectorizeOptions = {
  preset: 'draft' | 'standard' | 'fine';
  recipe: 'best' | 'paper' | 'diffvg';
  paths?: number | null;
  segments: number;
  levels?: number | null;
  iterations?: number | null;
  final_iterations?: number | null;
  seed: number;
  working_size?: number | null;
  fills?: 'solid' | 'gradient' | null;
  opacity: 'free' | 'opaque';
  layers: boolean;
};

/** Server rendering of a track, for browsers that cannot encode H.264. */
export type VideoRequest = {
  scene: Scene;
  landmarks: Landmarks;
  track: Track;
  fps: number;
  size: number;
  format: 'mp4' | 'webm' | 'gif';
};

/** A viseme from `t` on for `d` seconds. `weight`: how far the jaw opens, 1 as the viseme does. */
export type VisemeBlock = {
  t: number;
  d: number;
  viseme: 'sil' | 'PP' | 'FF' | 'TH' | 'DD' | 'kk' | 'CH' | 'SS' | 'nn' | 'RR' | 'aa' | 'E' | 'I' | 'O' | 'U';
  weight: number;
};

/** Blocks, as heard or as edited, to be formed by a mouth. Without `loudness` the head does not nod. */
export type VisemeTrackRequest = {
  visemes: VisemeBlock[];
  duration: number;
  loudness?: number[] | null;
  options: SpeechOptions;
  name: string;
  as: 'articulators' | 'landmarks';
};
