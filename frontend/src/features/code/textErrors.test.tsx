import { Text } from '@codemirror/state';
import { act, screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import { useTextFindings } from '@/store/problems/texts';
import { show } from '../../../harness/testing';
import { textErrors, textMarks, useTextErrors } from './textErrors';

describe('textErrors', () => {
  it.each([
    ['a.json', '{"a": 1}', null, ''],
    ['a.json', '{"a": 1,}', 8, 'This is not valid JSON'],
    ['a.json', '{"a": 01}', 7, 'This is not valid JSON'],
    ['a.json', '{"a": [1, 2', 11, 'This is not valid JSON'],
    ['a.json', '\n', 1, 'The file is empty'],
    ['a.yaml', 'a: 1\nb: [1, 2\n', 14, 'This is not YAML'],
    ['a.yml', 'a: 1\na: 2\n', 5, 'unique'],
    ['a.yaml', 'a: 1\n', null, ''],
    ['a.launch', '<launch>\n<node/>\n</lunch>', 17, '</lunch>'],
    ['a.urdf', '<robot/>', null, ''],
    ['a.md', '{', null, ''],
    ['a.json', `[${'1,'.repeat(300_000)}`, null, ''],
  ] as const)('%s', (path, text, offset, words) => {
    const [error] = textErrors(path, text);
    expect(error?.offset ?? null).toBe(offset);
    expect(error?.message ?? '').toContain(words);
    if (error) expect(error.line).toBe(text.slice(0, error.offset).split('\n').length);
  });
});

describe('textMarks', () => {
  it('reach to the end of the word, or of the line', () => {
    const text = Text.of(['{"a": oh}', '!!! and more']);
    const at = (offset: number) => {
      const [mark] = textMarks(text, {
        text: text.toString(),
        errors: [{ offset, line: 1, message: 'bad' }],
      });
      return mark && [text.sliceString(mark.from, mark.to), mark.severity, mark.message];
    };
    expect(at(6)).toEqual(['oh', 'error', 'bad']);
    expect(at(10)).toEqual(['!!! and more', 'error', 'bad']);
    expect(at(999)).toEqual(['', 'error', 'bad']);
  });

  it('are shown only for the text that they refer to', () => {
    const text = Text.of(['{']);
    const errors = textErrors('a.json', '{');
    expect(textMarks(text, { text: '{', errors })).toHaveLength(1);
    expect(textMarks(Text.of(['{}']), { text: '{', errors })).toEqual([]);
    expect(textMarks(text, undefined)).toEqual([]);
  });
});

describe('useTextErrors', () => {
  beforeEach(() => {
    vi.useFakeTimers({ toFake: ['setTimeout', 'clearTimeout'] });
    onTestFinished(() => {
      vi.useRealTimers();
    });
  });

  function Errors({ path, text }: { readonly path: string; readonly text: string | null }) {
    useTextErrors(path, text);
    const found = useTextFindings((state) => state.errors[path]);
    return <p>{found ? `${found.text.length} characters, ${found.errors.length} errors` : 'not read'}</p>;
  }
  const pass = (ms: number) => act(() => vi.advanceTimersByTime(ms));

  it('checks shortly after the last change', () => {
    const { rerender } = show(<Errors path="a.json" text="{" />);
    pass(200);
    rerender(<Errors path="a.json" text={'{\r\n\r}'} />);
    pass(299);
    expect(screen.getByText('not read')).toBeInTheDocument();
    pass(1);
    expect(screen.getByText('4 characters, 0 errors')).toBeInTheDocument();
    rerender(<Errors path="a.json" text="[" />);
    pass(300);
    expect(screen.getByText('1 characters, 1 errors')).toBeInTheDocument();
  });

  it.each([
    ['a.py', '('],
    ['a.json', null],
  ])('does not check %s with %s', (path, text) => {
    show(<Errors path={path} text={text} />);
    pass(1000);
    expect(screen.getByText('not read')).toBeInTheDocument();
  });

  it('forgets a file when its editor closes', () => {
    const { unmount } = show(<Errors path="a.json" text="{" />);
    pass(300);
    expect(useTextFindings.getState().errors['a.json']?.errors).toHaveLength(1);
    unmount();
    expect(useTextFindings.getState().errors).toEqual({});
  });
});
