import { screen } from '@testing-library/react';
import { describe, expect, it, vi } from 'vitest';
import { show } from '../../../harness/testing';
import { TextDifference } from './TextDifference';

const texts = () =>
  screen.getAllByRole('textbox').map((editor) => [editor.getAttribute('aria-label'), editor.textContent]);
const many = Array.from({ length: 30 }, (_, line) => `line ${line}`);

describe('TextDifference', () => {
  it('shows both texts side by side, read-only', () => {
    show(<TextDifference path="a.py" before="old" after="new" />);
    expect(texts()).toEqual([
      ['Before', 'old'],
      ['After', 'new'],
    ]);
    for (const editor of screen.getAllByRole('textbox'))
      expect(editor).toHaveAttribute('aria-readonly', 'true');
  });

  it('shows them one below the other in a narrow window', () => {
    vi.spyOn(window, 'matchMedia').mockImplementation(
      (query) =>
        ({
          matches: query === '(max-width: 900px)',
          addEventListener: () => undefined,
          removeEventListener: () => undefined,
        }) as unknown as MediaQueryList,
    );
    show(<TextDifference path="a.py" before="old" after="new" />);
    expect(texts()).toEqual([['After', 'oldnew']]);
    expect(screen.queryByRole('button')).toBeNull();
  });

  it('leaves out long equal parts', () => {
    const after = [...many.slice(0, -1), 'changed'].join('\n');
    show(<TextDifference path="a.txt" before={many.join('\n')} after={after} />);
    expect(screen.getAllByText('26 unchanged lines')).toHaveLength(2);
    expect(screen.queryByText('line 5')).toBeNull();
    expect(screen.getAllByText('line 27')).toHaveLength(2);
  });

  it('follows changes of its texts', () => {
    const { rerender } = show(<TextDifference path="a.py" before="old" after="new" />);
    rerender(<TextDifference path="a.py" before="old" after="newer" />);
    expect(texts()).toEqual([
      ['Before', 'old'],
      ['After', 'newer'],
    ]);
  });

  it('dims ids and positions in XML only', () => {
    const text = '<a _bts_id="x"/>';
    const { container, unmount } = show(<TextDifference path="tree.xml" before={text} after={text} />);
    expect(container.querySelectorAll('.cm-metadata')).toHaveLength(2);
    unmount();
    const other = show(<TextDifference path="tree.json" before={text} after={text} />);
    expect(other.container.querySelectorAll('.cm-metadata')).toHaveLength(0);
  });
});
