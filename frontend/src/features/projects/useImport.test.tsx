import { screen } from '@testing-library/react';
import { beforeEach, describe, expect, it } from 'vitest';
import type { Diagnostic } from '@/api/types';
import { useImportReport } from '@/store/dialogs/importReport';
import { projectDetail } from '@/store/testing';
import { refusal } from '../../../harness/requests';
import { fakeServer, show, user } from '../../../harness/testing';
import { useImport } from './useImport';

const IMPORT = 'POST /projects/import?filename=tree.xml&order=ask';
const file = new File(['<root/>'], 'tree.xml');

const finding = (code: string): Diagnostic => ({ code, severity: 'error', message: 'A bare &.', line: 3 });

function Page() {
  const { importFile, isImporting, offer, repair, mainTrees, chooseMain, orders, chooseOrder, decline } =
    useImport();
  return (
    <>
      <p>{offer ? `${offer.asked.file.name}: ${offer.changes.length} repairs` : 'no offer'}</p>
      <p>{isImporting ? 'importing' : 'idle'}</p>
      <button onClick={() => importFile(file)}>import</button>
      <button onClick={repair}>repair</button>
      <p>{mainTrees?.choices.map(({ main, tree, file: path }) => `${main}=${tree}@${path}`).join(' ')}</p>
      <button onClick={() => chooseMain('b.xml')}>choose</button>
      <p>{orders ? `other than ${orders.finding.values?.['order']}` : 'no order'}</p>
      <button onClick={() => chooseOrder('bottom-to-top')}>turn</button>
      <button onClick={decline}>decline</button>
    </>
  );
}

const answers: Record<string, unknown> = {};
let requests: ReturnType<typeof fakeServer>['requests'];
const click = (name: string) => user.click(screen.getByRole('button', { name }));

beforeEach(() => {
  for (const key of Object.keys(answers)) delete answers[key];
  ({ requests } = fakeServer(answers));
  window.history.pushState(null, '', '/');
  show(<Page />);
});

describe('useImport', () => {
  it('imports a file, and opens the project', async () => {
    answers[IMPORT] = { ...projectDetail(1, []), proposal: { universe: 'line', topics: '/image' } };
    await click('import');
    await expect.poll(() => window.location.pathname).toBe('/projects/p1');
    expect(requests[0]?.body).toBe(file);
    expect(useImportReport.getState()).toMatchObject({ file: 'tree.xml', proposal: { universe: 'line' } });
    expect(screen.getByText('no offer')).toBeInTheDocument();
    expect(screen.getByText('idle')).toBeInTheDocument();
  });

  it('offers to repair a file, and does it on confirmation', async () => {
    answers[IMPORT] = refusal('Not well-formed.', { diagnostics: [finding('BT0740'), finding('BT0740')] });
    answers[`${IMPORT}&repair=true`] = projectDetail(1, []);
    await click('import');
    expect(await screen.findByText('tree.xml: 2 repairs')).toBeInTheDocument();
    expect(screen.queryByText('Not well-formed.')).toBeNull();
    await click('repair');
    expect(screen.getByText('no offer')).toBeInTheDocument();
    await expect.poll(() => window.location.pathname).toBe('/projects/p1');
    expect(requests.at(-1)?.body).toBe(file);
  });

  it('imports nothing if the repair is declined', async () => {
    answers[IMPORT] = refusal('Not well-formed.', { diagnostics: [finding('BT0740')] });
    await click('import');
    await screen.findByText('tree.xml: 1 repairs');
    await click('decline');
    expect(screen.getByText('no offer')).toBeInTheDocument();
    await click('repair');
    expect(requests).toHaveLength(1);
  });

  it('asks for the main tree of several, also after a repair', async () => {
    const choice = (main: string, tree: string): Diagnostic => ({
      ...finding('BT0924'),
      tree,
      file: 'b.xml',
      values: { choice: main },
    });
    answers[IMPORT] = refusal('Not well-formed.', { diagnostics: [finding('BT0740')] });
    answers[`${IMPORT}&repair=true`] = refusal('Several.', {
      diagnostics: [choice('Go', 'Go'), choice('b.xml', 'Main')],
    });
    answers[`${IMPORT}&repair=true&main=b.xml`] = projectDetail(1, []);
    await click('import');
    await screen.findByText('tree.xml: 1 repairs');
    await click('repair');
    expect(await screen.findByText('Go=Go@b.xml b.xml=Main@b.xml')).toBeInTheDocument();
    expect(screen.queryByText('Several.')).toBeNull();
    await click('choose');
    await expect.poll(() => window.location.pathname).toBe('/projects/p1');
    expect(screen.queryByText(/=Main@/)).toBeNull();
  });

  it('asks which of several trees of a Python file it is, and keeps why one is one block', async () => {
    const several = { ...finding('BT0927'), file: 'tree.xml', values: { choice: 'patrol' } };
    answers[IMPORT] = refusal('Several.', { diagnostics: [several] });
    answers[`${IMPORT}&main=b.xml`] = { ...projectDetail(1, []), proposal: null, one_block: 'it is so' };
    await click('import');
    expect(await screen.findByText('patrol=patrol@tree.xml')).toBeInTheDocument();
    await click('choose');
    await expect.poll(() => window.location.pathname).toBe('/projects/p1');
    expect(useImportReport.getState().oneBlock).toBe('it is so');
  });

  it('asks for the order of a project whose own order leaves a branch out', async () => {
    const values = { order: 'top-to-bottom', other: 'bottom-to-top' };
    answers[IMPORT] = refusal('A branch.', { diagnostics: [{ ...finding('BT0811'), values }] });
    answers['POST /projects/import?filename=tree.xml&order=bottom-to-top'] = projectDetail(1, []);
    await click('import');
    expect(await screen.findByText('other than top-to-bottom')).toBeInTheDocument();
    expect(screen.queryByText('A branch.')).toBeNull();
    await click('turn');
    await expect.poll(() => window.location.pathname).toBe('/projects/p1');
    expect(screen.getByText('no order')).toBeInTheDocument();
  });

  it.each([
    ['has other faults, too', [finding('BT0740'), finding('BT0101')]],
    ['has none', []],
  ])('reports why a file was refused that %s', async (_, diagnostics) => {
    answers[IMPORT] = refusal('Not a project.', { hint: 'Take a zip.', diagnostics });
    await click('import');
    expect(await screen.findByText('That did not work')).toBeInTheDocument();
    expect(screen.getByText('Not a project. Take a zip.')).toBeInTheDocument();
    expect(screen.getByText('no offer')).toBeInTheDocument();
  });
});
