import { screen } from '@testing-library/react';
import { describe, expect, it } from 'vitest';
import type { Choice } from '@/model/choices';
import { vocabulary } from '@/model/testing';
import { show, user } from '../../../harness/testing';
import { PaletteGroup } from './PaletteGroup';

const choices: Choice[] = ['Sequence', 'Fallback'].map((type) => ({
  kind: { type },
  spec: vocabulary.specs.get(type)!,
  label: type,
}));
const title = () => screen.queryByRole('button', { name: /^Control/ });
const items = () => screen.queryAllByRole('button', { name: /^Add/ }).map(({ textContent }) => textContent);

describe('PaletteGroup', () => {
  it('counts its blocks, and folds', async () => {
    show(<PaletteGroup title="Control" choices={choices} isSearching={false} />);
    expect(title()).toHaveTextContent('Control2');
    expect(title()).toHaveAttribute('aria-expanded', 'true');
    expect(items()).toEqual(['Sequence', 'Fallback']);
    await user.click(title()!);
    expect(title()).toHaveAttribute('aria-expanded', 'false');
    expect(items()).toEqual([]);
    await user.click(title()!);
    expect(items()).toHaveLength(2);
  });

  it('is open while the user searches, and folded again after it', async () => {
    const group = (isSearching: boolean) => (
      <PaletteGroup title="Control" choices={choices} isSearching={isSearching} />
    );
    show(group(false));
    await user.click(title()!);
    show(group(true));
    expect(items()).toHaveLength(2);
  });

  it.each([
    [undefined, false, false],
    [undefined, true, false],
    ['No actions yet.', true, false],
    ['No actions yet.', false, true],
  ])('without blocks, with the text %s and a search: %s, is shown: %s', (empty, isSearching, isShown) => {
    const words = empty === undefined ? {} : { empty };
    show(<PaletteGroup title="Control" choices={[]} isSearching={isSearching} {...words} />);
    expect(title() !== null).toBe(isShown);
    expect(screen.queryByText('No actions yet.') !== null).toBe(isShown);
  });

  it('does not show the empty text if it has blocks', () => {
    show(<PaletteGroup title="Control" choices={choices} isSearching={false} empty="None." />);
    expect(screen.queryByText('None.')).toBeNull();
  });
});
