import { act, fireEvent, screen, within } from '@testing-library/react';
import { beforeEach, describe, expect, it, vi } from 'vitest';
import { perform } from '@/commands/registry';
import { openPalette, usePalette } from '@/commands/palette';
import { projectDetail } from '@/store/testing';
import { account, refusal } from '../../../harness/requests';
import { fakeServer, show, user } from '../../../harness/testing';
import { StartPage } from './StartPage';

const LIST = 'GET /projects?search=&sort=-updated_at&shelf=current&offset=0&limit=48';
const file = new File(['zip'], 'bump.zip', { type: 'application/zip' });

let answers: Record<string, unknown>;
let requests: ReturnType<typeof fakeServer>['requests'];
const address = () => window.location.pathname;

beforeEach(async () => {
  window.history.pushState(null, '', '/');
  answers = {
    'GET /me': account(),
    'GET /catalog/templates': [{ id: 'laser_bump_and_go', name: '', description: '' }],
    [LIST]: { items: [], total: 0, next_offset: null },
    'GET /runs': { items: [] },
  };
  ({ requests } = fakeServer(answers));
});

async function open() {
  const view = show(<StartPage />);
  await screen.findByTestId('new-from-laser_bump_and_go');
  return view;
}

const field = () => document.querySelector('input[type="file"]') as HTMLInputElement;

describe('StartPage', () => {
  it('has templates, projects, and the account menu', async () => {
    await open();
    expect(document.title).toBe('BT Studio');
    expect(screen.getByRole('heading', { level: 1 })).toHaveTextContent('New project');
    expect(await screen.findByText('No projects yet')).toBeInTheDocument();
    expect(await screen.findByRole('button', { name: /Account of ada$/ })).toBeInTheDocument();
  });

  it('loads the page of a project in advance; without it, that page reports what is wrong', async () => {
    const loadStudio = vi.fn(() => Promise.reject(new Error('offline')));
    show(<StartPage loadStudio={loadStudio} />);
    expect(loadStudio).toHaveBeenCalledOnce();
    expect(await screen.findByText('No projects yet')).toBeInTheDocument();
    expect(screen.queryByRole('alert')).toBeNull();
  });

  it('makes a project of a template, by its card or by its command', async () => {
    answers['POST /projects'] = projectDetail(1, []);
    await open();
    await user.click(screen.getByTestId('new-from-laser_bump_and_go'));
    await expect.poll(address).toBe('/projects/p1');
    act(() => perform('start.new.empty'));
    await expect
      .poll(() => requests.filter(({ path }) => path === '/projects').map(({ body }) => body))
      .toEqual([{ template: 'laser_bump_and_go' }, { template: 'empty' }]);
  });

  it('imports a file that was chosen', async () => {
    answers['POST /projects/import?filename=bump.zip&order=ask'] = projectDetail(1, []);
    await open();
    expect(field().accept).toBe('.zip,.xml,.btproj,.py,application/zip,text/xml');
    await user.upload(field(), file);
    await expect.poll(address).toBe('/projects/p1');
    expect(requests.at(-1)?.body).toBe(file);
  });

  it('makes a project of a log of a robot that was dropped on it', async () => {
    const id = '00000001-0000-0000-0000-000000000000';
    answers['POST /runs/logs?filename=patrol.btlog'] = { id, project: 'p7' };
    await open();
    const dataTransfer = { types: ['Files'], files: [new File(['log'], 'patrol.btlog')] };
    fireEvent.drop(window, { dataTransfer });
    await expect.poll(address).toBe('/projects/p7');
    expect(window.location.search).toBe(`?run=${id}`);
  });

  it('imports a file that was dropped on it', async () => {
    answers['POST /projects/import?filename=bump.zip&order=ask'] = projectDetail(1, []);
    await open();
    const dataTransfer = { types: ['Files'], files: [file] };
    fireEvent.dragOver(window, { dataTransfer });
    expect(screen.getByText(/^Drop a project zip/)).toBeInTheDocument();
    fireEvent.drop(window, { dataTransfer });
    expect(screen.queryByText(/^Drop a project zip/)).toBeNull();
    await expect.poll(address).toBe('/projects/p1');
  });

  it('offers to repair a file', async () => {
    const repair = { code: 'BT0740', severity: 'error', message: '', line: 3, column: 1 } as const;
    answers['POST /projects/import?filename=bump.zip&order=ask'] = refusal('Not well-formed.', {
      diagnostics: [repair],
    });
    await open();
    await user.upload(field(), file);
    const dialog = within(await screen.findByRole('dialog', { name: 'Repair the file?' }));
    await user.click(dialog.getByRole('button', { name: 'Do not import' }));
    expect(screen.queryByRole('dialog')).toBeNull();
    expect(address()).toBe('/');
  });

  it('has commands that choose a file and search', async () => {
    await open();
    let isAsked = false;
    field().addEventListener('click', () => (isAsked = true));
    act(() => perform('start.import'));
    expect(isAsked).toBe(true);
    act(() => perform('start.search'));
    expect(screen.getByRole('searchbox', { name: 'Search projects' })).toHaveFocus();
  });

  it('has the command palette, and unregisters at the end', async () => {
    const { unmount } = await open();
    act(() => openPalette());
    expect(await screen.findByText('New project: Empty project')).toBeInTheDocument();
    unmount();
    expect(usePalette.getState().page).toBeNull();
  });
});
