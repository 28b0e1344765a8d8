import { act, screen } from '@testing-library/react';
import { beforeEach, describe, expect, it } from 'vitest';
import { useProjectStore } from '@/store/project';
import { shownTarget } from '../../../harness/target';
import { nodeOf, openProject, show, user } from '../../../harness/testing';
import { LookFields } from './LookFields';

const Fields = shownTarget('Main', LookFields);
const pressed = () =>
  screen.getAllByRole('button', { pressed: true }).map((each) => each.getAttribute('aria-label'));
const steps = () => useProjectStore.getState().histories['Main']?.past.map(({ label }) => label);

beforeEach(() => {
  openProject({
    trees: { Main: { a: { type: 'Sequence', children: ['x'] }, x: { type: 'Nowhere' } } },
    selected: ['a'],
  });
});

describe('LookFields', () => {
  it('offers eight colours, and that of the family', () => {
    show(<Fields id="a" />);
    expect(screen.getAllByRole('button')).toHaveLength(9);
    expect(pressed()).toEqual(['Colour of the family']);
    const own = screen.getByRole('button', { name: 'Colour of the family' });
    expect(own.innerHTML).toContain('--bts-control');
  });

  it('shows the colour of an unknown type', () => {
    show(<Fields id="x" />);
    expect(screen.getByRole('button', { name: 'Colour of the family' }).innerHTML).toContain('--bts-unknown');
  });

  it('colours the block', async () => {
    show(<Fields id="a" />);
    await user.click(screen.getByRole('button', { name: '#be185d' }));
    expect(nodeOf('Main', 'a')?.color).toBe('#be185d');
    expect(pressed()).toEqual(['#be185d']);
    await user.click(screen.getByRole('button', { name: 'Colour of the family' }));
    expect(nodeOf('Main', 'a')?.color).toBeUndefined();
  });

  it('disables and enables the block, each a step with its name', async () => {
    show(<Fields id="a" />);
    const disabled = screen.getByRole('switch', { name: /^Disabled/ });
    expect(disabled).not.toBeChecked();
    expect(screen.getByText('Skipped when the tree runs, with all below it.')).toBeInTheDocument();
    await user.click(disabled);
    expect(nodeOf('Main', 'a')?.disabled).toBe(true);
    await user.click(disabled);
    expect(nodeOf('Main', 'a')?.disabled).toBeUndefined();
    expect(steps()).toEqual(['disable', 'enable']);
    act(() => useProjectStore.getState().undo());
    expect(disabled).toBeChecked();
  });
});
