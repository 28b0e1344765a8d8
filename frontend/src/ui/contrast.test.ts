import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';

type Tokens = Readonly<Record<string, string>>;

const css = readFileSync('src/ui/tokens.css', 'utf8');

function tokensOf(selector: string): Tokens {
  const start = css.indexOf(`${selector} {`);
  const block = css.slice(start, css.indexOf('}', start));
  return Object.fromEntries(
    [...block.matchAll(/--bts-([\w-]+): (#[0-9a-f]{6})/g)].map((each) => [each[1], each[2]]),
  );
}

function luminance(color: string): number {
  const [r = 0, g = 0, b = 0] = [1, 3, 5].map((at) => {
    const channel = parseInt(color.slice(at, at + 2), 16) / 255;
    return channel <= 0.04045 ? channel / 12.92 : ((channel + 0.055) / 1.055) ** 2.4;
  });
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}

function contrast(a: string, b: string): number {
  const [low, high] = [luminance(a), luminance(b)].sort((x, y) => x - y);
  return ((high ?? 0) + 0.05) / ((low ?? 0) + 0.05);
}

const grounds = ['bg', 'surface', 'surface-2', 'surface-3', 'canvas'];
const statuses = ['success', 'failure', 'running', 'skipped', 'warning'];
const families = ['control', 'decorator', 'action', 'condition', 'subtree', 'unknown'];

const light = tokensOf(':root');
const themes: [string, Tokens][] = [
  ['light', light],
  ['dark', { ...light, ...tokensOf("[data-mantine-color-scheme='dark']") }],
];

describe.each(themes)('the %s theme', (_name, token) => {
  const pairs: [string, string][] = [
    ...grounds.flatMap((ground) => [
      ['text', ground] as [string, string],
      ['muted', ground] as [string, string],
    ]),
    ...statuses.flatMap((status) => [
      [status, 'surface'] as [string, string],
      [status, `${status}-soft`] as [string, string],
      ['text', `${status}-soft`] as [string, string],
    ]),
    ...families.map((family) => ['on-family', family] as [string, string]),
    ['accent', 'surface'],
    ['accent', 'accent-soft'],
    ['accent', 'accent-soft-hover'],
    ['on-accent', 'accent'],
  ];
  it.each(pairs)('reads %s on %s at WCAG AA', (text, ground) => {
    expect(contrast(token[text] ?? '', token[ground] ?? '')).toBeGreaterThanOrEqual(4.5);
  });
});
