import { screen, within } from '@testing-library/react';
import { describe, expect, it } from 'vitest';
import { useProjectStore } from '@/store/project';
import { oneBlock, projectDetail, projectFile } from '@/store/testing';
import { fakeServer, openProject, show, user } from '../../../harness/testing';
import { Library } from './Library';

const behaviour = (id: string, summary: string, version = '1.1') => ({
  id,
  version,
  group: 'motion',
  summary: { en: summary },
  doc: { en: `More about ${id}.` },
  diagram: JSON.parse(oneBlock(id, 'AlwaysSuccess')) as unknown,
  files: { [`trees/${id}.json`]: oneBlock(id, 'AlwaysSuccess') },
});

const PROJECTS = '/projects?search=&sort=-updated_at&shelf=current&offset=0&limit=48';
const other = {
  ...projectDetail(4, [projectFile('trees/Patrol.json', 1, oneBlock('Patrol', 'AlwaysSuccess'))], 'Patrol'),
  id: 'p2',
  description: 'Goes around.',
};

function open(answers: Record<string, unknown> = {}) {
  openProject({ trees: { Main: { r: { type: 'Sequence', children: [] } } } });
  fakeServer({
    'GET /catalog/behaviours': [behaviour('Dock', 'Goes home.'), behaviour('Follow', 'Follows a wall.')],
    [`GET ${PROJECTS}`]: {
      items: [
        { id: 'p1', name: 'This one' },
        { id: 'p2', name: 'Other' },
      ],
      total: 2,
      next_offset: null,
    },
    'GET /projects/p2': other,
    ...answers,
  });
  show(<Library />);
}

const offers = () => screen.queryAllByTestId(/^behaviour-/).map((row) => row.dataset['testid']?.slice(10));

describe('Library', () => {
  it('finds behaviours by all words of a search', async () => {
    open();
    await screen.findByTestId('behaviour-Dock');
    expect(offers()).toEqual(['Dock', 'Follow']);
    await user.type(screen.getByLabelText('Search behaviours'), 'wall follow');
    expect(offers()).toEqual(['Follow']);
    await user.type(screen.getByLabelText('Search behaviours'), ' home');
    expect(screen.getByText('No behaviour is like that.')).toBeInTheDocument();
  });

  it('inserts a behaviour with its files', async () => {
    open();
    await user.click(await screen.findByRole('button', { name: 'Insert Dock' }));
    const { diagrams, currentText } = useProjectStore.getState();
    expect(diagrams['Dock']?.nodes['n1']?.type).toBe('AlwaysSuccess');
    expect(Object.values(diagrams['Main']?.nodes ?? {})).toContainEqual(
      expect.objectContaining({ type: 'SubTree', tree: 'Dock' }),
    );
    expect(currentText('assets/library.json')).toContain('1.1');
    expect(await screen.findByText('Dock is in the tree, with its actions.')).toBeInTheDocument();
    expect(screen.queryByTestId('update-Dock')).toBeNull();
  });

  it('tells more about a behaviour on demand', async () => {
    open();
    const row = within(await screen.findByTestId('behaviour-Dock'));
    const name = row.getByRole('button', { expanded: false });
    expect(row.queryByText('More about Dock.')).toBeNull();
    await user.click(name);
    expect(row.getByText('More about Dock.')).toBeInTheDocument();
    expect(row.getByText('Version 1.1')).toBeInTheDocument();
    expect(row.getByText('Brings 1 file')).toBeInTheDocument();
    expect(row.getByText('trees/Dock.json')).toBeInTheDocument();
    await user.click(name);
    expect(row.queryByText('More about Dock.')).toBeNull();
  });

  it('says why there is no library', async () => {
    open({
      'GET /catalog/behaviours': Response.json({ detail: 'It is away.', code: 'gone' }, { status: 404 }),
    });
    expect(await screen.findByText(/It is away\./)).toBeInTheDocument();
  });

  it('takes trees from another project', async () => {
    open();
    await screen.findByTestId('behaviour-Dock');
    await user.click(screen.getByRole('combobox', { name: 'Where from' }));
    expect(await screen.findByRole('option', { name: 'Other' })).toBeInTheDocument();
    expect(screen.queryByRole('option', { name: 'This one' })).toBeNull();
    await user.click(screen.getByRole('option', { name: 'Other' }));
    expect(await screen.findByTestId('behaviour-Patrol')).toHaveTextContent('Goes around.');
    expect(offers()).toEqual(['Patrol']);
  });
});
