import { expect, it } from 'vitest';
import { exportLines } from './environment';

it.each([
  [{}, ''],
  [{ A: '1', B: '' }, 'export A=1\nexport B='],
  [{ A: 'a/b:c@d%e+f,g-h.i_j' }, 'export A=a/b:c@d%e+f,g-h.i_j'],
  [{ A: 'a b' }, "export A='a b'"],
  [{ A: '$HOME' }, "export A='$HOME'"],
  [{ A: "it's" }, "export A='it'\\''s'"],
])('writes %j for a shell', (environment: Record<string, string>, lines) => {
  expect(exportLines(environment)).toBe(lines);
});
