// Generated from openapi.json by `npm run gen`; never edited by hand.

/** What the server answers instead of a value; `message` is one sentence for the user. */
export type ApiError = {
  code: 'bad_picture' | 'picture_too_large' | 'bad_option' | 'bad_landmarks' | 'bad_project' | 'bad_track' | 'bad_audio' | 'not_found' | 'queue_full' | 'storage_full' | 'unsupported' | 'cancelled' | 'bad_request' | 'internal';
  message: string;
};

export type Body_add_portrait = {
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
};

export type Iris = {
  centre: [number, number];
  radius: number;
};

/** Landmarks None: no face; the picture becomes back and fore only as far as segmentation finds a person. */
export type JobRequest = {
  portrait_id: string;
  landmarks?: Landmarks | null;
  options: VectorizeOptions;
};

/** Whole snapshot of a job, the only thing SSE ever sends. `revision` grows by one a snapshot.
 *
 * `scene_revision` names the latest scene at `/api/jobs/{id}/scene`; 0: none yet. */
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

/** Two-stop linear gradient from `start` to `end`, padded, unpremultiplied sRGB. */
export type LinearFill = {
  kind: 'linear';
  start: [number, number];
  end: [number, number];
  stops: [Stop, Stop];
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
