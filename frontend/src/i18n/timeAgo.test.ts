import { expect, it } from 'vitest';
import { timeAgo } from './timeAgo';

const NOW = Date.UTC(2026, 5, 1);
const before = (seconds: number) => new Date(NOW - seconds * 1000).toISOString();

it.each([
  [0, 'now'],
  [59, 'now'],
  [60, '1 minute ago'],
  [89, '1 minute ago'],
  [91, '2 minutes ago'],
  [3600, '1 hour ago'],
  [3 * 3600, '3 hours ago'],
  [86_400, 'yesterday'],
  [6 * 86_400, '6 days ago'],
  [604_800, 'last week'],
  [3 * 604_800, '3 weeks ago'],
  [2_592_000, 'last month'],
  [31_536_000, 'last year'],
  [3 * 31_536_000, '3 years ago'],
  [-7200, 'in 2 hours'],
])('shows %s s ago as %s', (seconds, words) => {
  expect(timeAgo(before(seconds), 'en', NOW)).toBe(words);
});

it("uses the page's language, and the current time by default", () => {
  expect(timeAgo(new Date(Date.now() - 3 * 60_000 - 1000).toISOString(), 'es')).toBe('hace 3 minutos');
});
