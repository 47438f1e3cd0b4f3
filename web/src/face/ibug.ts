/** The 68 iBUG landmarks: what each is called, which group it belongs to, and its mirror image. Left is image-left. */

export const N_LANDMARKS = 68;

export type GroupName = 'jaw' | 'left_brow' | 'right_brow' | 'nose' | 'left_eye' | 'right_eye' | 'outer_lips' | 'inner_lips';

export type Group = {
  readonly name: GroupName;
  readonly label: string;
  readonly first: number;
  readonly count: number;
  /** Whether the last point joins the first. */
  readonly closed: boolean;
};

export const GROUPS: readonly Group[] = [
  { name: 'jaw', label: 'Jaw', first: 0, count: 17, closed: false },
  { name: 'left_brow', label: 'Left brow', first: 17, count: 5, closed: false },
  { name: 'right_brow', label: 'Right brow', first: 22, count: 5, closed: false },
  { name: 'nose', label: 'Nose', first: 27, count: 9, closed: false },
  { name: 'left_eye', label: 'Left eye', first: 36, count: 6, closed: true },
  { name: 'right_eye', label: 'Right eye', first: 42, count: 6, closed: true },
  { name: 'outer_lips', label: 'Outer lips', first: 48, count: 12, closed: true },
  { name: 'inner_lips', label: 'Inner lips', first: 60, count: 8, closed: true },
];

export const OUTER_EYE_CORNERS = [36, 45] as const;
export const NOSE_TIP = 30;
export const MOUTH_CORNERS = [48, 54] as const;

/** Landmark indices of a group, in order. */
export function indicesOf(group: Group): number[] {
  return Array.from({ length: group.count }, (_, k) => group.first + k);
}

export function groupNamed(name: GroupName): Group {
  const group = GROUPS.find((candidate) => candidate.name === name);
  if (!group) throw new RangeError(`No landmark group is called ${name}`);
  return group;
}

export function groupOf(index: number): Group {
  const group = GROUPS.find(({ first, count }) => index >= first && index < first + count);
  if (!group) throw new RangeError(`Landmark ${index} is outside 0 to ${N_LANDMARKS - 1}`);
  return group;
}

const MIRROR_CHAINS: readonly (readonly [number, number])[] = [
  ...pairs([0, 1, 2, 3, 4, 5, 6, 7], [16, 15, 14, 13, 12, 11, 10, 9]),
  ...pairs([17, 18, 19, 20, 21], [26, 25, 24, 23, 22]),
  ...pairs([31, 32], [35, 34]),
  ...pairs([36, 37, 38, 39, 40, 41], [45, 44, 43, 42, 47, 46]),
  ...pairs([48, 49, 50, 59, 58], [54, 53, 52, 55, 56]),
  ...pairs([60, 61, 67], [64, 63, 65]),
];

function pairs(left: readonly number[], right: readonly number[]): [number, number][] {
  return left.map((index, k) => [index, right[k]]);
}

const MIRROR = mirrorTable();

function mirrorTable(): readonly number[] {
  const table = Array.from({ length: N_LANDMARKS }, (_, index) => index);
  for (const [left, right] of MIRROR_CHAINS) {
    table[left] = right;
    table[right] = left;
  }
  return table;
}

/** The landmark on the other half of the face; points of the middle line are their own mirror image. */
export function mirrorOf(index: number): number {
  return MIRROR[index];
}

const CORNERS: Readonly<Record<number, string>> = {
  8: 'Chin',
  30: 'Nose tip',
  36: 'Left eye, outer corner',
  39: 'Left eye, inner corner',
  42: 'Right eye, inner corner',
  45: 'Right eye, outer corner',
  48: 'Mouth corner, left',
  51: 'Upper lip, middle',
  54: 'Mouth corner, right',
  57: 'Lower lip, middle',
  60: 'Inner mouth corner, left',
  62: 'Upper lip, inner middle',
  64: 'Inner mouth corner, right',
  66: 'Lower lip, inner middle',
};

const LIDS: readonly { readonly from: number; readonly to: number; readonly label: string }[] = [
  { from: 37, to: 38, label: 'Left eye, upper lid' },
  { from: 40, to: 41, label: 'Left eye, lower lid' },
  { from: 43, to: 44, label: 'Right eye, upper lid' },
  { from: 46, to: 47, label: 'Right eye, lower lid' },
  { from: 49, to: 53, label: 'Upper lip' },
  { from: 55, to: 59, label: 'Lower lip' },
  { from: 61, to: 63, label: 'Upper lip, inner' },
  { from: 65, to: 67, label: 'Lower lip, inner' },
];

/** What a landmark is called to people: "Mouth corner, left", "Jaw 3". */
export function landmarkName(index: number): string {
  if (CORNERS[index]) return CORNERS[index];
  const lid = LIDS.find(({ from, to }) => index >= from && index <= to);
  if (lid) return `${lid.label} ${index - lid.from + 1}`;
  const group = groupOf(index);
  return `${group.label} ${index - group.first + 1}`;
}

const UPPER = new Set([37, 38, 43, 44, 49, 50, 51, 52, 53, 61, 62, 63]);
const LOWER = new Set([40, 41, 46, 47, 55, 56, 57, 58, 59, 65, 66, 67]);

/** Whether two landmarks lie on opposite sides of an opening: a dragged lip or lid must not take the other one along. */
export function faceEachOther(a: number, b: number): boolean {
  return (UPPER.has(a) && LOWER.has(b)) || (LOWER.has(a) && UPPER.has(b));
}
