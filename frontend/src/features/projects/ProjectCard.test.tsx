import { fireEvent, screen, waitFor } from '@testing-library/react';
import { beforeEach, describe, expect, it } from 'vitest';
import type { ProjectShelf } from '@/api/client';
import type { ProjectSummary } from '@/api/types';
import { noContent, refusal, summary } from '../../../harness/requests';
import { fakeServer, show, user } from '../../../harness/testing';
import { ProjectCard } from './ProjectCard';
import { useProjectCommands } from './useProjects';

function Card({ shelf, project }: { readonly shelf: ProjectShelf; readonly project: ProjectSummary }) {
  return (
    <>
      <ProjectCard project={project} shelf={shelf} actions={useProjectCommands()} />
      <button>elsewhere</button>
    </>
  );
}

function open(answers: Readonly<Record<string, unknown>> = {}, shelf: ProjectShelf = 'current', more = {}) {
  const { requests } = fakeServer(answers);
  show(<Card shelf={shelf} project={summary('p 1', { name: 'Bump', ...more })} />);
  return requests;
}

const link = () => screen.getByRole('link', { name: 'Bump' });
const picture = () => document.querySelector('a[tabindex="-1"]') as HTMLAnchorElement;
const address = () => window.location.pathname;

beforeEach(() => window.history.pushState(null, '', '/'));

describe('ProjectCard', () => {
  it('shows when the project was changed', () => {
    open({}, 'current', { updated_at: new Date(Date.now() - 3 * 60_000).toISOString() });
    expect(screen.getByText('Changed 3 minutes ago')).toBeInTheDocument();
  });

  it('opens the project by its name or its picture', async () => {
    open();
    expect(link()).toHaveAttribute('href', '/projects/p%201');
    await user.click(link());
    expect(address()).toBe('/projects/p%201');
    window.history.pushState(null, '', '/');
    await user.click(picture());
    expect(address()).toBe('/projects/p%201');
  });

  it.each([{ ctrlKey: true }, { metaKey: true }, { button: 1 }])(
    'leaves a click for another tab to the browser',
    (press) => {
      open();
      let isTaken = true;
      const leave = (event: Event) => {
        isTaken = event.defaultPrevented;
        // jsdom cannot open pages.
        event.preventDefault();
      };
      window.addEventListener('click', leave, { once: true });
      fireEvent.click(link(), press);
      expect([address(), isTaken]).toEqual(['/', false]);
    },
  );

  it('does not open a deleted project, but restores it', async () => {
    const requests = open({ 'POST /projects/p%201/restore': noContent() }, 'deleted');
    expect(screen.queryByRole('link', { name: 'Bump' })).toBeNull();
    expect(screen.getByTitle('Bump')).toBeInTheDocument();
    expect(screen.queryByRole('button', { name: 'More for Bump' })).toBeNull();
    await user.click(picture());
    expect(address()).toBe('/');
    await user.click(screen.getByRole('button', { name: 'Restore' }));
    await waitFor(() => expect(requests.map(({ path }) => path)).toEqual(['/projects/p%201/restore']));
  });
});

describe('renaming', () => {
  const RENAME = 'PATCH /projects/p%201';
  const field = () => screen.getByRole('textbox', { name: 'Rename' }) as HTMLInputElement;

  async function rename(answers: Readonly<Record<string, unknown>> = {}) {
    const requests = open(answers);
    await user.click(screen.getByRole('button', { name: 'More for Bump' }));
    await user.click(screen.getByRole('menuitem', { name: 'Rename' }));
    return () => requests.map(({ body }) => body);
  }

  it('starts with the name selected', async () => {
    await rename();
    expect(field()).toHaveValue('Bump');
    expect([field().selectionStart, field().selectionEnd]).toEqual([0, 4]);
  });

  it.each([
    ['Enter', '{Enter}'],
    ['leaving the field', '{Tab}'],
  ])('saves a name by %s', async (_, key) => {
    const names = await rename({ [RENAME]: noContent() });
    await user.clear(field());
    field().focus();
    await user.keyboard(` Go home ${key === '{Tab}' ? '' : key}`);
    if (key === '{Tab}') fireEvent.blur(field(), { relatedTarget: screen.getByText('elsewhere') });
    await waitFor(() => expect(names()).toEqual([{ name: 'Go home', base_revision: 3 }]));
  });

  it.each(['{Escape}', '{Enter}'])('ends without a change by %s', async (key) => {
    const names = await rename();
    if (key === '{Escape}') await user.type(field(), ' and go');
    field().focus();
    await user.keyboard(key);
    expect(link()).toBeInTheDocument();
    expect(names()).toEqual([]);
    await user.click(screen.getByRole('button', { name: 'More for Bump' }));
    await user.click(screen.getByRole('menuitem', { name: 'Rename' }));
    expect(field()).toHaveValue('Bump');
  });

  it('keeps the old name after an empty one', async () => {
    const names = await rename();
    await user.clear(field());
    field().focus();
    await user.keyboard('{Enter}');
    expect(link()).toBeInTheDocument();
    expect(names()).toEqual([]);
  });

  it('refuses a path as a name, until it is changed', async () => {
    const names = await rename();
    await user.clear(field());
    await user.type(field(), 'a/b{Enter}');
    expect(screen.getByText(/A name is not a path/)).toBeInTheDocument();
    expect(names()).toEqual([]);
    await user.type(field(), '{Escape}');
    expect(link()).toBeInTheDocument();
  });

  it('keeps a name that the server refuses in the field', async () => {
    await rename({ [RENAME]: refusal('The name is taken.', { hint: 'Take another.' }) });
    await user.clear(field());
    await user.type(field(), 'Taken{Enter}');
    expect(await screen.findByText('The name is taken. Take another.')).toBeInTheDocument();
    expect(field()).toHaveValue('Taken');
  });

  it('keeps the focus when the menu that started it returns it', async () => {
    const names = await rename();
    fireEvent.blur(field(), { relatedTarget: picture() });
    await waitFor(() => expect(field()).toHaveFocus());
    expect(names()).toEqual([]);
  });
});
