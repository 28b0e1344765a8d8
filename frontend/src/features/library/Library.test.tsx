import { screen, waitFor, within } from '@testing-library/react';
import { describe, expect, it } from 'vitest';
import { useProjectStore } from '@/store/project';
import { oneBlock, projectDetail, projectFile } from '@/store/testing';
import { account } from '../../../harness/requests';
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

const OFFERS = 'GET /projects/offers?offset=0&limit=20';
const PROJECTS = '/projects?search=&sort=-updated_at&shelf=current&offset=0&limit=48';
const other = {
  ...projectDetail(4, [projectFile('trees/Patrol.json', 1, oneBlock('Patrol', 'AlwaysSuccess'))], 'Patrol'),
  id: 'p2',
  description: 'Goes around.',
};

function open(answers: Record<string, unknown> = {}) {
  openProject({ trees: { Main: { r: { type: 'Sequence', children: [] } } } });
  const server = fakeServer({
    'GET /me': account(),
    [OFFERS]: { items: [], next_offset: null },
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
  return server;
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
    expect(screen.getByText('No behaviour matches the search.')).toBeInTheDocument();
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

  it('reports why there is no library', async () => {
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

  it('shows the trees that a project offers, and the others on demand', async () => {
    const offered = JSON.stringify({
      ...(JSON.parse(oneBlock('Dock', 'AlwaysSuccess')) as object),
      attributes: { _bts_offered: '1' },
    });
    open({
      'GET /projects/p2': { ...other, files: [...other.files, projectFile('trees/Dock.json', 1, offered)] },
    });
    await screen.findByTestId('behaviour-Follow');
    expect(screen.queryByRole('switch')).toBeNull();
    await user.click(screen.getByRole('combobox', { name: 'Where from' }));
    await user.click(await screen.findByRole('option', { name: 'Other' }));
    await waitFor(() => expect(offers()).toEqual(['Dock']));
    await user.click(screen.getByRole('switch', { name: 'Show all trees, also those not offered' }));
    expect(offers()).toEqual(['Patrol', 'Dock']);
  });

  it('shows what projects offer before the built-in ones, and finds it by its project', async () => {
    const files = {
      'trees/Charge.json': JSON.stringify({
        ...(JSON.parse(oneBlock('Charge', 'AlwaysSuccess')) as object),
        attributes: { _bts_offered: '1', _description: 'Fills the battery.' },
      }),
    };
    const one = { description: '', revision: 2, main_tree: 'Main', trees: ['Charge'], files };
    open({
      [OFFERS]: {
        items: [
          { ...one, project: 'p2', name: 'Rover', owner: 'ada' },
          { ...one, project: 'p3', name: 'Class', owner: 'bob' },
        ],
        next_offset: null,
      },
    });
    const list = await screen.findByRole('list', { name: 'Offered by projects' });
    expect(list).toHaveTextContent('From RoverFills the battery.');
    expect(list).toHaveTextContent('From Class by bob');
    expect(screen.getByRole('heading', { name: 'Built-in library' })).toBeInTheDocument();
    expect(offers()).toEqual(['Charge', 'Charge', 'Dock', 'Follow']);
    await user.type(screen.getByLabelText('Search behaviours'), 'rover');
    expect(offers()).toEqual(['Charge']);
    await user.click(screen.getByRole('button', { name: 'Insert Charge' }));
    expect(useProjectStore.getState().currentText('assets/library.json')).toContain('p2/Charge');
  });

  it('has the built-in ones where the offers cannot be read', async () => {
    open({ [OFFERS]: Response.json({ detail: 'It is away.', code: 'gone' }, { status: 404 }) });
    expect(await screen.findByText(/It is away\./)).toBeInTheDocument();
    expect(offers()).toEqual(['Dock', 'Follow']);
  });

  it('finds a project by its name, and keeps the chosen one in the list', async () => {
    const found = PROJECTS.replace('search=', 'search=Ro');
    const { requests } = open({
      [`GET ${found}`]: { items: [{ id: 'p3', name: 'Rover' }], total: 1, next_offset: null },
    });
    await screen.findByTestId('behaviour-Dock');
    const source = screen.getByRole('combobox', { name: 'Where from' });
    expect(source).toHaveValue('Built-in and offered');
    await user.click(source);
    await user.click(await screen.findByRole('option', { name: 'Other' }));
    await screen.findByTestId('behaviour-Patrol');
    await user.clear(source);
    await user.type(source, 'Ro');
    expect(await screen.findByRole('option', { name: 'Rover' })).toBeInTheDocument();
    const searches = requests.filter(({ path }) => path.startsWith('/projects?')).map(({ path }) => path);
    expect(searches).toContain(found);
    expect(searches.some((path) => path.includes('Built'))).toBe(false);
    expect(searches.some((path) => path.includes('Other'))).toBe(false);
    await user.clear(source);
    await user.type(source, 'zz');
    expect(await screen.findByText('No project has this name.')).toBeInTheDocument();
    await user.clear(source);
    await user.click(screen.getByRole('option', { name: 'Built-in and offered' }));
    await waitFor(() => expect(offers()).toEqual(['Dock', 'Follow']));
  });

  it('shows that it is loading, and not yet that it is empty', async () => {
    open();
    expect(screen.getByLabelText('Loading the behaviours')).toBeInTheDocument();
    expect(screen.queryByText('No behaviour matches the search.')).toBeNull();
    await screen.findByTestId('behaviour-Dock');
    expect(screen.queryByLabelText('Loading the behaviours')).toBeNull();
    expect(screen.queryByText('No behaviour matches the search.')).toBeNull();
  });

  it('finds text in the summary, the name and the description, whatever its case', async () => {
    open();
    await screen.findByTestId('behaviour-Dock');
    const search = screen.getByLabelText('Search behaviours');
    for (const [words, expected] of [
      ['HOME', ['Dock']],
      ['more  ABOUT', ['Dock', 'Follow']],
      ['follow', ['Follow']],
    ] as const) {
      await user.clear(search);
      await user.type(search, words);
      expect(offers()).toEqual(expected);
    }
  });

  it('updates a behaviour that the project has in another version', async () => {
    openProject({
      trees: { Main: { r: { type: 'Sequence' } } },
      texts: {
        'assets/library.json': JSON.stringify({
          behaviours: {
            'library/Dock': { source: 'library', version: '1.0', places: {} },
            'library/Follow': { source: 'library', version: '1.1', places: {} },
          },
        }),
      },
    });
    fakeServer({
      'GET /me': account(),
      [OFFERS]: { items: [], next_offset: null },
      'GET /catalog/behaviours': [behaviour('Dock', 'Goes home.'), behaviour('Follow', 'Follows a wall.')],
      [`GET ${PROJECTS}`]: { items: [], total: 0, next_offset: null },
    });
    show(<Library />);
    expect(await screen.findByTestId('update-Dock')).toBeInTheDocument();
    expect(screen.queryByTestId('update-Follow')).toBeNull();
  });
});
