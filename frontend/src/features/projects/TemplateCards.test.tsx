import { screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import { fakeServer, show, user } from '../../../harness/testing';
import { TemplateCards } from './TemplateCards';

const onCreate = vi.fn();
const diagram = {
  format: 'bt-studio/diagram',
  version: 1,
  id: 'Main',
  root: 'a',
  nodes: { a: { type: 'Sequence' } },
  drafts: [],
};

beforeEach(() => {
  fakeServer({
    'GET /catalog/templates': [
      { id: 'laser_bump_and_go', name: 'x', description: 'y', root_diagram: diagram },
      { id: 'mine', name: 'My own', description: 'Mine.', root_diagram: diagram },
    ],
  });
});

const card = (id: string) => screen.findByTestId(`new-from-${id}`);

describe('TemplateCards', () => {
  it('shows each template with its tree, and no example', async () => {
    show(<TemplateCards onCreate={onCreate} pending={null} />);
    expect(await card('mine')).toHaveTextContent('My ownMine.');
    expect((await card('mine')).querySelectorAll('rect')).toHaveLength(1);
    expect((await card('empty')).querySelector('.tabler-icon-plus')).not.toBeNull();
    expect(screen.queryByTestId('new-from-laser_bump_and_go')).toBeNull();
  });

  it('makes a project', async () => {
    show(<TemplateCards onCreate={onCreate} pending={null} />);
    await user.click(await card('mine'));
    expect(onCreate).toHaveBeenCalledExactlyOnceWith('mine');
  });

  it('makes no other while one is being made', async () => {
    onCreate.mockClear();
    show(<TemplateCards onCreate={onCreate} pending="empty" />);
    expect(await card('mine')).toBeDisabled();
    expect(await card('empty')).toBeDisabled();
    expect((await card('empty')).querySelector('.mantine-Loader-root')).not.toBeNull();
    expect((await card('mine')).querySelector('.mantine-Loader-root')).toBeNull();
  });
});
