import { expect, it } from 'vitest';
import { rowsOf } from './rows';

it('begins a line with its place, if it has one', () => {
  const rows = rowsOf(
    [
      { file: 'a.xacro', line: 3, text: 'no GPS' },
      { file: '', line: null, text: 'two wheels' },
    ],
    'warning',
  );
  expect(rows.map(({ text, severity }) => [text, severity])).toEqual([
    ['a.xacro:3: no GPS', 'warning'],
    ['two wheels', 'warning'],
  ]);
});
