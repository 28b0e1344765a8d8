import { screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import { fakeServer, show, user } from '../../../../harness/testing';
import { ExampleShelf } from './ExampleShelf';

const onCreate = vi.fn();
const template = (id: string, universe: string) => ({ id, name: id, description: '', universe });

beforeEach(() => {
  onCreate.mockClear();
  fakeServer({
    'GET /catalog/templates': [
      template('explore_maze', 'small_maze'),
      template('laser_bump_and_go', 'walled_room'),
      template('mine', 'empty'),
    ],
  });
});

describe('ExampleShelf', () => {
  it('shows each example with its world, its subject and its level', async () => {
    show(<ExampleShelf onCreate={onCreate} pending={null} />);
    const first = await screen.findByTestId('new-from-laser_bump_and_go');
    expect(first).toHaveTextContent('1. Laser bump and go');
    expect(first).toHaveTextContent('First steps');
    expect(first.querySelector('img')?.getAttribute('src')).toContain('walled_room');
    expect(screen.getAllByRole('listitem')).toHaveLength(2);
    expect(screen.queryByTestId('new-from-mine')).toBeNull();
  });

  it('makes a project', async () => {
    show(<ExampleShelf onCreate={onCreate} pending={null} />);
    await user.click(await screen.findByTestId('new-from-explore_maze'));
    expect(onCreate).toHaveBeenCalledExactlyOnceWith('explore_maze');
  });

  it('makes no other while one is being made', async () => {
    show(<ExampleShelf onCreate={onCreate} pending="explore_maze" />);
    const maze = await screen.findByTestId('new-from-explore_maze');
    expect(maze).toBeDisabled();
    expect(maze.querySelector('.mantine-Loader-root')).not.toBeNull();
    expect(screen.getByTestId('new-from-laser_bump_and_go')).toBeDisabled();
  });
});
