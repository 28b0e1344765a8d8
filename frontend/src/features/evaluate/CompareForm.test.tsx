import { screen } from '@testing-library/react';
import { expect, it, vi } from 'vitest';
import '@/i18n/editorTexts';
import { fakeServer, show, user } from '../../../harness/testing';
import { CompareForm } from './CompareForm';

function open(suggested: number | null) {
  const revision = (number: number) => ({
    number,
    label: '',
    message: `m${number}`,
    created_at: '2026-01-01',
  });
  fakeServer({
    'GET /projects/p1/revisions?limit=100&before=7': { items: [revision(6), revision(5)], next_before: null },
  });
  const compare = vi.fn();
  const props = { projectId: 'p1', before: 7, suggested, onCompare: compare, onCancel: vi.fn() };
  show(<CompareForm {...props} />);
  return compare;
}

it.each([
  [5, /Revision 5 · evaluated before · m5/],
  [2, /Revision 2 · evaluated before/],
])('begins with the revision %i that was evaluated before', async (suggested, name) => {
  const compare = open(suggested);
  expect(await screen.findByRole('option', { name, selected: true })).toBeInTheDocument();
  await user.click(screen.getByRole('button', { name: 'Compare' }));
  expect(compare).toHaveBeenCalledWith(suggested);
});

it('offers the older revisions, the last one first', async () => {
  const compare = open(null);
  const choice = screen.getByLabelText('With an older revision');
  expect(await screen.findByRole('option', { name: /Revision 6 · m6/ })).toBeInTheDocument();
  await user.selectOptions(choice, '5');
  await user.click(screen.getByRole('button', { name: 'Compare' }));
  expect(compare).toHaveBeenCalledWith(5);
});

it('says why the revisions cannot be read', async () => {
  fakeServer({
    'GET /projects/p1/revisions?limit=100&before=7': Response.json(
      { title: 'Not found', code: 'not_found', status: 404 },
      { status: 404 },
    ),
  });
  const props = { projectId: 'p1', before: 7, suggested: null, onCompare: vi.fn(), onCancel: vi.fn() };
  show(<CompareForm {...props} />);
  expect(await screen.findByRole('alert')).toHaveTextContent('It is gone');
  expect(screen.getByRole('button', { name: 'Compare' })).toBeDisabled();
});
