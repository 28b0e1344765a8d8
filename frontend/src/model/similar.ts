/** Returns the Damerau–Levenshtein distance of two names. */

function distance(a: string, b: string): number {
  const width = b.length + 1;
  const rows = new Array<number>((a.length + 1) * width).fill(0);
  const at = (i: number, j: number) => rows[i * width + j] ?? 0;
  for (let i = 0; i <= a.length; i += 1) rows[i * width] = i;
  for (let j = 0; j <= b.length; j += 1) rows[j] = j;
  for (let i = 1; i <= a.length; i += 1) {
    for (let j = 1; j <= b.length; j += 1) {
      const cost = a[i - 1] === b[j - 1] ? 0 : 1;
      let best = Math.min(at(i - 1, j) + 1, at(i, j - 1) + 1, at(i - 1, j - 1) + cost);
      if (i > 1 && j > 1 && a[i - 1] === b[j - 2] && a[i - 2] === b[j - 1]) {
        best = Math.min(best, at(i - 2, j - 2) + 1);
      }
      rows[i * width + j] = best;
    }
  }
  return at(a.length, b.length);
}

/** Returns up to `limit` similar names, the nearest first. */
export function similarNames(name: string, names: Iterable<string>, limit = 2): string[] {
  const wanted = name.toLowerCase().slice(0, 100);
  const allowed = Math.min(3, Math.max(1, Math.floor(wanted.length / 3)));
  return [...names]
    .map((each) => ({ each, far: distance(wanted, each.toLowerCase().slice(0, 100)) }))
    .filter(({ each, far }) => each !== name && far <= allowed)
    .sort((a, b) => a.far - b.far || a.each.localeCompare(b.each))
    .slice(0, limit)
    .map(({ each }) => each);
}
