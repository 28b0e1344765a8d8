import { act, screen, waitFor, within } from '@testing-library/react';
import { beforeEach, expect, it, onTestFinished, vi } from 'vitest';
import type { Candidate, ImportedPart } from '@/api/imports';
import { useImported } from '@/features/editor3d/imported';
import '@/i18n/editorTexts';
import { closeImporting, openImporting, useImporting } from '@/store/dialogs/importing';
import { useProjectStore } from '@/store/project';
import { useUniverseChoice } from '@/store/run/universeChoice';
import { projectDetail, projectFile } from '@/store/testing';
import { type, write } from '../../../harness/documents';
import { refusal } from '../../../harness/requests';
import { fakeServer, openProject, show, user, watchNavigation } from '../../../harness/testing';
import { ImportDialog } from './ImportDialog';

const CART: Candidate = {
  kind: 'robot',
  source: 'xacro',
  path: 'cart/urdf/cart.urdf.xacro',
  name: 'cart',
  is_main: true,
  arguments: [
    { name: 'radius', default: '0.1' },
    { name: 'prefix', default: null },
  ],
};
const WHEEL: Candidate = {
  ...CART,
  path: 'cart/urdf/wheel.xacro',
  name: 'wheel',
  is_main: false,
  arguments: [],
};
const YARD: Candidate = {
  ...WHEEL,
  kind: 'universe',
  source: 'sdf',
  path: 'yard.sdf',
  name: 'yard',
  is_main: true,
};
const PART: ImportedPart = {
  revision: 2,
  previous_revision: 1,
  path: 'robots/cart/robot.yaml',
  name: 'cart',
  paths: ['robots/cart/robot.yaml'],
  removed: [],
  report: {
    taken: [{ file: '', line: null, text: 'two wheels' }],
    assumed: [],
    left_out: [{ file: 'cart.urdf.xacro', line: 12, text: 'the sensor gps is not simulated' }],
  },
  test_drive: { way_m: 0.99, aside_m: 0, turn_deg: 331.2, fits: false },
  can_simplify: false,
  things: null,
};
const INSPECT = 'POST /projects/p1/imports/inspect?filename=cart.zip';
const TAKE =
  'POST /projects/p1/imports?filename=cart.zip&kind=robot&main=cart%2Furdf%2Fcart.urdf.xacro&name=cart' +
  '&use=true&replace=false&simplify=false&arg=prefix%3A%3Da';

const ZIP = new File(['x'], 'cart.zip');

function begin(answers: Parameters<typeof fakeServer>[0], texts: Readonly<Record<string, string>> = {}) {
  const server = fakeServer({
    'GET /projects/p1': projectDetail(2, [projectFile('robots/cart/robot.yaml', 2, 'name: Cart\n')]),
    ...answers,
  });
  openProject({ texts });
  show(<ImportDialog projectId="p1" />);
  act(() => openImporting('robot', { name: 'cart.zip', files: [{ path: 'cart.zip', file: ZIP }] }));
  return server;
}

beforeEach(() => {
  closeImporting();
  useImported.setState({ step: null });
});

it('imports what was dragged: asks for what is not given, and shows the report with the test drive', async () => {
  const { openFile } = watchNavigation();
  const { requests } = begin({ [INSPECT]: { items: [CART, WHEEL, YARD], left_out: [] }, [TAKE]: PART });
  expect(await screen.findByTestId('import-name')).toHaveValue('cart');
  // A file that another includes, and a world, are there for those who look for them.
  expect(screen.getAllByRole('radio')).toHaveLength(1);
  expect(screen.getByTestId('import-take')).toBeDisabled();
  expect(screen.getByLabelText('radius')).toHaveValue('0.1');
  // Enter sends the form.
  await write(screen.getByLabelText(/prefix/), 'a');
  const report = await screen.findByTestId('part-report');
  expect(requests.find(({ path }) => path.includes('/imports?'))?.body).toBe(ZIP);
  expect(screen.getByRole('dialog', { name: /^Imported from/ })).toBeInTheDocument();
  const [way, turn] = within(screen.getByTestId('test-drive')).getAllByRole('listitem');
  expect(way).toHaveTextContent(/^1 m: 0\.99 m$/);
  expect(turn).toHaveTextContent('360°: 331° (not within 10°)');
  expect(report).toHaveTextContent('cart.urdf.xacro:12 the sensor gps is not simulated');
  expect(useProjectStore.getState().currentText('robots/cart/robot.yaml')).toBe('name: Cart\n');
  await user.click(screen.getByTestId('import-open'));
  expect(openFile).toHaveBeenCalledExactlyOnceWith('robots/cart/robot.yaml', undefined);
  expect(useImporting.getState().isOpen).toBe(false);
  expect(useImported.getState().step).toMatchObject({ before: 1, after: 2, path: 'robots/cart/robot.yaml' });
});

it('asks before it replaces a robot of the same name', async () => {
  const answers = { [INSPECT]: { items: [WHEEL], left_out: [] } };
  begin(answers, { 'robots/wheel/robot.yaml': '' });
  expect(await screen.findByText(/already has a robot with this name/)).toBeInTheDocument();
  expect(screen.getByTestId('import-take')).toBeDisabled();
  await user.click(screen.getByRole('switch', { name: 'Replace that robot' }));
  expect(screen.getByTestId('import-take')).toBeEnabled();
});

it('says what failed with its place and what to do', async () => {
  const diagnostics = [
    {
      code: '',
      severity: 'error',
      message: 'No package has the name arm.',
      hint: 'Copy it.',
      file: 'a.xacro',
      line: 3,
    },
  ] as const;
  begin({
    [INSPECT]: { items: [{ ...CART, arguments: [] }], left_out: [] },
    [TAKE.replace('&arg=prefix%3A%3Da', '')]: refusal('No.', {
      status: 422,
      code: 'import_refused',
      diagnostics: [...diagnostics],
    }),
  });
  await user.click(await screen.findByTestId('import-take'));
  expect(await screen.findByRole('alert')).toHaveTextContent(
    'a.xacro:3 No package has the name arm. Copy it.',
  );
  expect(screen.getByTestId('import-name')).toHaveValue('cart');
});

it('keeps what was entered when it failed', async () => {
  const query = TAKE.replace('&name=cart', '&name=rover').replace('&use=true', '&use=false');
  begin({
    [INSPECT]: { items: [YARD, { ...CART, is_main: false }], left_out: [] },
    [query]: refusal('No.', { status: 422 }),
  });
  await user.click(await screen.findByRole('button', { name: 'Show 1 more file' }));
  await user.click(screen.getByRole('radio', { name: /cart.urdf.xacro/ }));
  await user.click(screen.getByRole('switch', { name: 'Run this project with it' }));
  await type('import-name', 'rover');
  await write(screen.getByLabelText(/prefix/), 'a');
  await screen.findByRole('alert');
  expect(screen.getByTestId('import-name')).toHaveValue('rover');
  expect(screen.getByRole('radio', { name: /cart.urdf.xacro/ })).toBeChecked();
  expect(screen.getByLabelText(/prefix/)).toHaveValue('a');
  expect(screen.getByRole('switch', { name: 'Run this project with it' })).not.toBeChecked();
});

it('runs the project with it, in place of a temporary choice', async () => {
  useUniverseChoice.setState({ universe: 'maze', robot: 'burger' });
  onTestFinished(() => useUniverseChoice.setState(useUniverseChoice.getInitialState(), true));
  begin({ [INSPECT]: { items: [CART], left_out: [] }, [TAKE]: PART });
  await write(await screen.findByLabelText(/prefix/), 'a');
  await screen.findByTestId('part-report');
  expect(useUniverseChoice.getState()).toMatchObject({ universe: 'maze', robot: null });
});

it('keeps the report when the part cannot be made simpler', async () => {
  begin({ [INSPECT]: { items: [CART], left_out: [] }, [TAKE]: { ...PART, can_simplify: true } });
  await write(await screen.findByLabelText(/prefix/), 'a');
  await user.click(await screen.findByRole('button', { name: 'Simplify and import again' }));
  expect(await screen.findByRole('alert')).toBeInTheDocument();
  expect(screen.getByTestId('part-report')).toBeInTheDocument();
  expect(screen.getByTestId('import-undo')).toBeInTheDocument();
});

it('offers to undo what came in although it was cancelled', async () => {
  begin({
    [INSPECT]: { items: [CART], left_out: [] },
    'POST /projects/p1/revisions/1/restore': projectDetail(3, []),
  });
  await screen.findByTestId('import-name');
  const { fetch } = globalThis;
  vi.stubGlobal('fetch', async (request: Request) => {
    if (!request.url.includes('/imports?')) return fetch(request);
    return new Promise((_, fail) => {
      request.signal.addEventListener('abort', () =>
        fail(Object.assign(new Error(''), { name: 'AbortError' })),
      );
    });
  });
  await write(screen.getByLabelText(/prefix/), 'a');
  await waitFor(() => expect(useImporting.getState().isBusy).toBe(true));
  await user.click(await screen.findByTestId('import-cancel'));
  expect(await screen.findByText('“cart” had been imported before it was cancelled.')).toBeInTheDocument();
  expect(await screen.findByTestId('import-name')).toHaveValue('cart');
  expect(useImporting.getState()).toMatchObject({ finished: null, isBusy: false });
  await user.click(screen.getByRole('button', { name: 'Undo the import' }));
  expect(await screen.findByText('The import of “cart” is undone.')).toBeInTheDocument();
});

it('says when nothing can be imported, and takes other files', async () => {
  begin({ [INSPECT]: { items: [], left_out: [] } });
  expect(await screen.findByText(/There is no robot, world or map/)).toBeInTheDocument();
  await user.click(screen.getByRole('button', { name: 'Choose other files' }));
  expect(screen.getByTestId('import-area')).toHaveTextContent('A robot as URDF, xacro or SDF');
});

it('ends what is being done when the user cancels', async () => {
  const signals: AbortSignal[] = [];
  fakeServer({});
  openProject({});
  show(<ImportDialog projectId="p1" />);
  vi.stubGlobal(
    'fetch',
    ({ signal }: Request) =>
      new Promise((_, fail) => {
        signals.push(signal);
        signal.addEventListener('abort', () => fail(Object.assign(new Error(''), { name: 'AbortError' })));
      }),
  );
  act(() => openImporting(null, { name: 'cart.zip', files: [{ path: 'cart.zip', file: ZIP }] }));
  await waitFor(() => expect(signals).toHaveLength(1));
  await user.click(screen.getByTestId('import-cancel'));
  expect(await screen.findByTestId('import-area')).toBeInTheDocument();
  expect(signals[0]?.aborted).toBe(true);
  expect(screen.queryByRole('alert')).toBeNull();
});
