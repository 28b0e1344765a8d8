import { QueryClientProvider } from '@tanstack/react-query';
import { renderHook, waitFor } from '@testing-library/react';
import { describe, expect, it } from 'vitest';
import { queries } from '@/api/queries';
import { oneBlock, projectDetail, projectFile } from '@/store/testing';
import { account } from '../../../harness/requests';
import { fakeServer } from '../../../harness/testing';
import { useLibrary, useOffers, useOtherProjects, useTreesOf } from './useReusables';

const query = <T,>(use: () => T) =>
  renderHook(use, {
    wrapper: ({ children }) => <QueryClientProvider client={queries}>{children}</QueryClientProvider>,
  });

const behaviour = {
  id: 'Dock',
  version: '1.1',
  group: 'motion',
  summary: { en: 'Goes home.', es: 'Va a casa.' },
  doc: { en: 'More.' },
  diagram: { id: 'Dock' },
  files: { 'trees/Dock.json': '{}' },
};

describe('useLibrary', () => {
  it.each([
    ['en', 'Goes home.', 'More.'],
    ['es-MX', 'Va a casa.', 'More.'],
    ['de', 'Goes home.', 'More.'],
  ])('has the behaviours in %s, or in English', async (language, summary, doc) => {
    fakeServer({ 'GET /catalog/behaviours': [behaviour] });
    const { result } = query(() => useLibrary(language));
    await waitFor(() => expect(result.current.data).toBeDefined());
    expect(result.current.data).toEqual([
      {
        id: 'Dock',
        version: '1.1',
        group: 'motion',
        source: 'library',
        project: null,
        owner: null,
        isOffered: true,
        summary,
        doc,
        diagram: { id: 'Dock' },
        files: { 'trees/Dock.json': '{}' },
      },
    ]);
  });

  it('has empty texts if there are none', async () => {
    fakeServer({ 'GET /catalog/behaviours': [{ ...behaviour, summary: {} }] });
    const { result } = query(() => useLibrary('en'));
    await waitFor(() => expect(result.current.data?.[0]?.summary).toBe(''));
  });
});

it('lists the other projects that match a search, the newest first', async () => {
  const path = '/projects?search=ro&sort=-updated_at&shelf=current&offset=0&limit=48';
  const items = [
    { id: 'p1', name: 'Robot' },
    { id: 'p2', name: 'Rover' },
  ];
  const { requests } = fakeServer({ [`GET ${path}`]: { items, total: 2, next_offset: null } });
  const { result } = query(() => useOtherProjects('p1', 'ro'));
  await waitFor(() => expect(result.current.data).toEqual([items[1]]));
  expect(requests.map((each) => each.path)).toEqual([path]);
});

describe('useOffers', () => {
  const offered = (id: string) =>
    JSON.stringify({
      ...(JSON.parse(oneBlock(id, 'AlwaysSuccess')) as object),
      attributes: { _bts_offered: '1' },
    });
  const offer = (project: string, owner: string) => ({
    project,
    name: `Name of ${project}`,
    description: '',
    owner,
    revision: 3,
    main_tree: 'Main',
    trees: ['Dock'],
    files: { 'trees/Dock.json': offered('Dock'), 'trees/Wait.json': oneBlock('Wait', 'AlwaysSuccess') },
  });

  it('has the offered trees of all pages, without those of this project', async () => {
    const { requests } = fakeServer({
      'GET /me': account(),
      'GET /projects/offers?offset=0&limit=20': {
        items: [offer('p1', 'ada'), offer('p2', 'ada')],
        next_offset: 20,
      },
      'GET /projects/offers?offset=20&limit=20': { items: [offer('p3', 'bob')], next_offset: null },
    });
    const { result } = query(() => useOffers('p1'));
    await waitFor(() => expect(result.current.data).toHaveLength(2));
    expect(
      result.current.data?.map(({ id, source, version, project, owner }) => [
        id,
        source,
        version,
        project,
        owner,
      ]),
    ).toEqual([
      ['Dock', 'p2', 'r3', 'Name of p2', null],
      ['Dock', 'p3', 'r3', 'Name of p3', 'bob'],
    ]);
    expect(requests).toHaveLength(3);
  });

  it('asks nothing for a visitor with a link', async () => {
    const { requests } = fakeServer({ 'GET /me': account({ role: 'guest' }) });
    const { result } = query(() => useOffers('p1'));
    await waitFor(() => expect(requests).toHaveLength(1));
    expect(result.current.fetchStatus).toBe('idle');
  });
});

describe('useTreesOf', () => {
  const detail = {
    ...projectDetail(7, [
      projectFile('trees/Patrol.json', 1, oneBlock('Patrol', 'AlwaysSuccess')),
      projectFile('actions/Turn.py', 1, 'class Turn: ...'),
    ]),
    id: 'p2',
    main_tree: 'Patrol',
    description: 'Goes around.',
  };
  const files = [...detail.files, { ...projectFile('mesh.stl', 1, ''), content: null }];

  it('has the trees of a project, with their descriptions', async () => {
    fakeServer({ 'GET /projects/p2': { ...detail, files } });
    const { result } = query(() => useTreesOf('p2'));
    await waitFor(() => expect(result.current.data).toBeDefined());
    expect(result.current.data).toEqual([
      expect.objectContaining({
        id: 'Patrol',
        source: 'p2',
        version: 'r7',
        group: 'project',
        summary: 'Goes around.',
        doc: '',
        project: 'Test',
        isOffered: false,
      }),
    ]);
    expect(result.current.data?.[0]?.diagram).toMatchObject({ id: 'Patrol', root: 'n1' });
  });

  it('fetches the actions that are left out of the project', async () => {
    const large = { ...projectFile('actions/Turn.py', 1, ''), content: null, left_out: true };
    const mesh = { ...projectFile('mesh.stl', 1, ''), content: null, left_out: true };
    const turning = projectFile('trees/Patrol.json', 1, oneBlock('Patrol', 'Turn'));
    fakeServer({
      'GET /projects/p2': { ...detail, files: [large, mesh, turning] },
      'GET /projects/p2/files/actions/Turn.py': new Response('class Turn: ...'),
    });
    const { result } = query(() => useTreesOf('p2'));
    await waitFor(() => expect(result.current.data).toBeDefined());
    expect(result.current.data?.[0]?.files).toMatchObject({ 'actions/Turn.py': 'class Turn: ...' });
  });

  it('requests nothing without a project', () => {
    const { requests } = fakeServer({});
    const { result } = query(() => useTreesOf(null));
    expect(result.current.fetchStatus).toBe('idle');
    expect(requests).toEqual([]);
  });

  it('has the description of each tree; of the main one, else that of the project', async () => {
    const dock = JSON.stringify({
      ...(JSON.parse(oneBlock('Dock', 'AlwaysSuccess')) as object),
      attributes: { _description: 'Goes home.', _bts_offered: '1' },
    });
    const trees = [
      projectFile('trees/Dock.json', 1, dock),
      projectFile('trees/Main.json', 1, oneBlock('Main', 'AlwaysSuccess')),
      projectFile('trees/Wait.json', 1, oneBlock('Wait', 'AlwaysSuccess')),
    ];
    fakeServer({ 'GET /projects/p2': { ...detail, main_tree: 'Main', files: trees } });
    const { result } = query(() => useTreesOf('p2'));
    await waitFor(() => expect(result.current.data).toBeDefined());
    expect(result.current.data?.map(({ id, summary, isOffered }) => [id, summary, isOffered])).toEqual([
      ['Dock', 'Goes home.', true],
      ['Main', 'Goes around.', false],
      ['Wait', '', false],
    ]);
  });
});
