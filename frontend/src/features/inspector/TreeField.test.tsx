import { screen } from '@testing-library/react';
import { beforeEach, describe, expect, it } from 'vitest';
import { shownTarget } from '../../../harness/target';
import { nodeOf, openProject, show, user } from '../../../harness/testing';
import { TreeField } from './TreeField';

const Field = shownTarget('Main', TreeField);
const field = () => screen.getByRole('combobox', { name: 'Tree' });
const options = () => screen.queryAllByRole('option').map(({ textContent }) => textContent);
const leaf = { d: { type: 'AlwaysSuccess' } };

beforeEach(() => {
  openProject({
    trees: {
      Main: {
        r: { type: 'Sequence', children: ['s', 'n'] },
        s: { type: 'SubTree', tree: 'Dock', name: 'Home', ports: { x: '1' } },
        n: { type: 'SubTree' },
      },
      Dock: leaf,
      Park: leaf,
      Loop: { d: { type: 'SubTree', tree: 'Main' } },
      Deeper: { d: { type: 'SubTree', tree: 'Loop' } },
    },
  });
});

describe('TreeField', () => {
  it('offers the trees that do not contain this one', async () => {
    show(<Field id="s" />);
    expect(field()).toHaveValue('Dock');
    await user.click(field());
    expect(options()).toEqual(['Dock', 'Park']);
  });

  it('keeps name and ports after a change of the tree', async () => {
    show(<Field id="s" />);
    await user.click(field());
    await user.click(screen.getByRole('option', { name: 'Park' }));
    expect(nodeOf('Main', 's')).toEqual({ type: 'SubTree', tree: 'Park', name: 'Home', ports: { x: '1' } });
  });

  it('does nothing if the same tree is chosen', async () => {
    show(<Field id="s" />);
    await user.click(field());
    await user.click(screen.getByRole('option', { name: 'Dock' }));
    expect(nodeOf('Main', 's')?.tree).toBe('Dock');
  });

  it('is empty for a subtree without a tree', () => {
    show(<Field id="n" />);
    expect(field()).toHaveValue('');
  });

  it('finds a tree by its name', async () => {
    show(<Field id="n" />);
    await user.type(field(), 'par');
    expect(options()).toEqual(['Park']);
    await user.click(screen.getByRole('option', { name: 'Park' }));
    expect(nodeOf('Main', 'n')?.tree).toBe('Park');
  });
});
