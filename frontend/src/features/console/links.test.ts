import { describe, expect, it } from 'vitest';
import { findLinks } from './links';

const FILES = new Set(['actions/Forward.py', 'launch/a.py']);

describe('findLinks', () => {
  it.each([
    ['Forward.py:12', 'actions/Forward.py', 12],
    ['actions/Forward.py:7', 'actions/Forward.py', 7],
    ['./actions/Forward.py:7', 'actions/Forward.py', 7],
    ['/tmp/x/actions/Forward.py:7', 'actions/Forward.py', 7],
    ['launch/a.py:1', 'launch/a.py', 1],
    ['File "actions/Forward.py", line 30', 'actions/Forward.py', 30],
  ])('finds the line in %s', (text, path, line) => {
    expect(findLinks(text, FILES)).toEqual([{ text, path, line }]);
  });

  it('keeps the text around a link', () => {
    expect(findLinks('see Forward.py:1, Forward.py:2.', FILES)).toEqual([
      { text: 'see ' },
      { text: 'Forward.py:1', path: 'actions/Forward.py', line: 1 },
      { text: ', ' },
      { text: 'Forward.py:2', path: 'actions/Forward.py', line: 2 },
      { text: '.' },
    ]);
  });

  it('ignores files that are not in the project', () => {
    expect(findLinks('lib/other.py:3', FILES)).toEqual([{ text: 'lib/other.py:3' }]);
    expect(findLinks('a.py:3 Forward.py:1', FILES)[0]).toEqual({ text: 'a.py:3 ' });
    expect(findLinks('', FILES)).toEqual([{ text: '' }]);
  });
});
