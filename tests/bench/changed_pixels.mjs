// Counts the pixels that differ between two screenshots, all in all and by the mesh triangles they lie in.

const TOLERANCE = 2; // of 255, in any channel
const BORDER = 2; // screen pixels of antialiasing along a triangle
const MOST_PLACES = 20;

/** Pixels of two equally large PNGs that differ. */
export async function changedPixels(page, before, after) {
  return (await triangleChanges(page, '', '', before, after)).elsewhere;
}

/**
 * Pixels that differ in triangles that moved, in the neighbours that share a corner with those (curves join on smoothly
 * there), and elsewhere. Meshes are path data of triangles in pixels of the screenshots.
 */
export function triangleChanges(page, meshBefore, meshAfter, before, after) {
  return page.evaluate(countChanges, {
    meshes: [meshBefore, meshAfter],
    shots: [before.toString('base64'), after.toString('base64')],
    tolerance: TOLERANCE,
    border: BORDER,
    mostPlaces: MOST_PLACES,
  });
}

/** Runs in the page. */
async function countChanges({ meshes, shots, tolerance, border, mostPlaces }) {
  const decode = async (base64) => {
    const bytes = Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
    const bitmap = await createImageBitmap(new Blob([bytes], { type: 'image/png' }));
    const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d');
    context.drawImage(bitmap, 0, 0);
    return context.getImageData(0, 0, bitmap.width, bitmap.height);
  };
  const [p, q] = [await decode(shots[0]), await decode(shots[1])];
  const [rest, posed] = meshes.map((d) => d.split('Z').filter(Boolean));
  const indices = rest.map((_, index) => index);
  const moved = indices.filter((index) => rest[index] !== posed[index]);
  const corners = (index) => rest[index].slice(1).split('L');
  const touched = new Set(moved.flatMap(corners));
  const beside = indices.filter((index) => rest[index] === posed[index] && corners(index).some((corner) => touched.has(corner)));

  const cover = (triangles) => {
    const context = new OffscreenCanvas(p.width, p.height).getContext('2d');
    const area = new Path2D(triangles.map((d) => `${d}Z`).join(''));
    context.lineWidth = 2 * border;
    context.fill(area);
    context.stroke(area);
    return context.getImageData(0, 0, p.width, p.height).data;
  };
  const inMoved = cover(moved.flatMap((index) => [rest[index], posed[index]]));
  const inBeside = cover(beside.map((index) => rest[index]));
  const counts = { triangles: indices.length, movedTriangles: moved.length, inside: 0, beside: 0, elsewhere: 0 };
  const places = []; // of the first changes elsewhere, with the change of each channel
  for (let at = 0; at < p.data.length; at += 4) {
    const changes = [0, 1, 2].map((channel) => q.data[at + channel] - p.data[at + channel]);
    if (changes.every((change) => Math.abs(change) <= tolerance)) continue;
    const where = inMoved[at + 3] ? 'inside' : inBeside[at + 3] ? 'beside' : 'elsewhere';
    counts[where] += 1;
    if (where === 'elsewhere' && places.length < mostPlaces) places.push([(at / 4) % p.width, Math.floor(at / 4 / p.width), ...changes]);
  }
  return { ...counts, places };
}
