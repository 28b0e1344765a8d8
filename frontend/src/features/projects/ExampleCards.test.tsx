import { screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import { show, user } from '../../../harness/testing';
import { ExampleCards } from './ExampleCards';

const onCreate = vi.fn();
const nodes = { a: { type: 'Sequence', children: ['b'] }, b: { type: 'IsNear' } };
const root_diagram = { format: 'bt-studio/diagram', version: 1, id: 'Main', root: 'a', nodes, drafts: [] };
const examples = [
  { id: 'laser_bump_and_go', name: 'x', description: 'y', root_diagram, conditions: ['IsNear'] },
  { id: 'mine', name: 'My own', description: 'Mine.', root_diagram: null, conditions: [] },
].map((each) => ({ ...each, universe: '' }));
const open = (pending: string | null = null) =>
  show(<ExampleCards examples={examples} onCreate={onCreate} pending={pending} />);
const card = (id: string) => screen.getByTestId(`new-from-${id}`);

beforeEach(() => onCreate.mockClear());

describe('ExampleCards', () => {
  it('shows each example with its tree, its own conditions in their colour', () => {
    open();
    expect(card('laser_bump_and_go')).toHaveTextContent(/^Laser bump and goDrives ahead until/);
    const fills = [...card('laser_bump_and_go').querySelectorAll('rect')].map((box) =>
      box.getAttribute('fill'),
    );
    expect(fills).toEqual(['var(--bts-control)', 'var(--bts-condition)']);
    expect(card('mine')).toHaveTextContent('My ownMine.');
  });

  it('makes a project, and no other meanwhile', async () => {
    const { unmount } = open();
    await user.click(card('mine'));
    expect(onCreate).toHaveBeenCalledExactlyOnceWith('mine');
    unmount();
    open('mine');
    expect(card('laser_bump_and_go')).toBeDisabled();
    expect(card('mine').querySelector('.mantine-Loader-root')).not.toBeNull();
  });
});
