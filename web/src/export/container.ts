/** The two kinds of video files. */
import type { OutputFormat } from 'mediabunny';

export type VideoKind = 'mp4' | 'webm';

export const MEDIA_TYPES: Readonly<Record<VideoKind, string>> = { mp4: 'video/mp4', webm: 'video/webm' };

export async function fileFormat(kind: VideoKind): Promise<OutputFormat> {
  const { Mp4OutputFormat, WebMOutputFormat } = await import('mediabunny');
  return kind === 'mp4' ? new Mp4OutputFormat({ fastStart: 'in-memory' }) : new WebMOutputFormat();
}
