import { fireEvent, screen, within } from '@testing-library/react';
import { describe, expect, it } from 'vitest';
import type { Diagnostic, PackagePreview } from '@/api/types';
import { refusal } from '../../../harness/requests';
import { fakeServer, openProject, show, user } from '../../../harness/testing';
import { PackageSection } from './PackageSection';

const preview = (more: Partial<PackagePreview> = {}): PackagePreview => ({
  name: 'bump',
  files: [
    { path: 'tree_gardener/engine.py', size: 1023 },
    { path: 'bump/package.xml', size: 1024 },
    { path: 'bump/setup.py', size: 1587 },
    { path: 'bumper/other.py', size: 0 },
  ],
  manifest: '<package><exec_depend>rclpy</exec_depend><depend>geometry_msgs</depend></package>',
  diagnostics: [],
  ...more,
});

const note = (message: string, hint?: string): Diagnostic => ({
  code: 'X1',
  severity: 'warning',
  message,
  ...(hint ? { hint } : {}),
});

const PREVIEW = 'GET /projects/p/package/preview?name=';

async function open(answer: PackagePreview, more: Readonly<Record<string, unknown>> = {}) {
  const { requests } = fakeServer({ [PREVIEW]: answer, ...more });
  show(<PackageSection projectId="p" />);
  await screen.findByTestId('package-files');
  return () => requests.map(({ path }) => path);
}

const name = () => screen.getByTestId('package-name');
const download = () => screen.getByRole('link', { name: 'Download package' }).getAttribute('href');

describe('PackageSection', () => {
  it("lists the files with their sizes, the user's own first", async () => {
    await open(preview());
    expect(screen.getByText('4 files')).toBeInTheDocument();
    const rows = within(screen.getByTestId('package-files')).getAllByRole('listitem');
    expect(rows.map((row) => [...row.children].map(({ textContent }) => textContent))).toEqual([
      ['bump/package.xml', '1 kB'],
      ['bump/setup.py', '1.5 kB'],
      ['tree_gardener/engine.py', '1,023 byte'],
      ['bumper/other.py', '0 byte'],
    ]);
  });

  it('lists the dependencies', async () => {
    await open(preview());
    expect(
      [...screen.getByTestId('package-dependencies').children].map(({ textContent }) => textContent),
    ).toEqual(['geometry_msgs', 'rclpy']);
  });

  it('shows how the package is built and run, with copy buttons', async () => {
    await open(preview());
    const commands = 'colcon build && source install/setup.bash\nros2 launch bump bump.launch.py';
    expect(screen.getByTestId('take-away-commands').textContent).toBe(commands);
    await user.click(screen.getByRole('button', { name: 'Copy' }));
    expect(await navigator.clipboard.readText()).toBe(commands);
    expect(screen.getByRole('button', { name: 'Copied' })).toBeInTheDocument();
  });

  it('shows the notes about it', async () => {
    await open(preview({ diagnostics: [note('It has no test.', 'Write one.'), note('It has no licence.')] }));
    const alert = screen.getByRole('alert');
    expect(alert).toHaveTextContent('2 things to know');
    expect(
      within(alert)
        .getAllByRole('listitem')
        .map(({ textContent }) => textContent),
    ).toEqual(['It has no test. Write one.', 'It has no licence.']);
  });

  it('has no notes for a package without findings', async () => {
    await open(preview());
    expect(screen.queryByRole('alert')).toBeNull();
  });

  it('downloads under the default name, or under another', async () => {
    const asked = await open(preview(), { [`${PREVIEW}patrol_2`]: preview({ name: 'patrol_2' }) });
    expect(name()).toHaveAttribute('placeholder', 'bump');
    expect(download()).toBe('/api/v1/projects/p/package?name=');
    fireEvent.change(name(), { target: { value: ' patrol_2 ' } });
    expect(download()).toBe('/api/v1/projects/p/package?name=patrol_2');
    expect(await screen.findByText(/ros2 launch patrol_2/)).toBeInTheDocument();
    expect(asked()).toEqual([
      '/projects/p/package/preview?name=',
      '/projects/p/package/preview?name=patrol_2',
    ]);
  });

  it('refuses a name that ROS would refuse, and keeps the default one', async () => {
    await open(preview());
    expect(screen.queryByText(/single underscores/)).toBeNull();
    await user.type(name(), 'Bad Name');
    expect(
      screen.getByText('Lower-case letters, digits and single underscores; a letter first.'),
    ).toBeInTheDocument();
    expect(download()).toBe('/api/v1/projects/p/package?name=');
    await user.clear(name());
    expect(screen.queryByText(/single underscores/)).toBeNull();
  });

  it('reports why there is no package', async () => {
    const diagnostics = [{ ...note('Go is missing.', 'Add it.'), severity: 'error' as const }];
    fakeServer({ [PREVIEW]: refusal('The project has errors.', { diagnostics }) });
    show(<PackageSection projectId="p" />);
    const alert = await screen.findByTestId('take-away-refused');
    expect(alert).toHaveTextContent('The project has errors, so there is no package yet');
    expect(
      within(alert)
        .getAllByRole('listitem')
        .map(({ textContent }) => textContent),
    ).toEqual(['Go is missing. Add it.']);
    expect(alert).not.toHaveTextContent('The project has errors.');
    expect(screen.queryByRole('link')).toBeNull();
  });

  it('requests no package for a project with errors', async () => {
    const { requests } = fakeServer({ [PREVIEW]: preview() });
    openProject({ diagnostics: [{ ...note('Go is missing.', 'Add it.'), severity: 'error' }] });
    show(<PackageSection projectId="p" />);
    expect(await screen.findByTestId('take-away-refused')).toHaveTextContent('Go is missing. Add it.');
    expect(requests).toEqual([]);
  });

  it('shows the reason of any other refusal', async () => {
    fakeServer({ [PREVIEW]: refusal('The disk is full.', { status: 507 }) });
    show(<PackageSection projectId="p" />);
    expect(await screen.findByText('The disk is full.')).toBeInTheDocument();
    expect(screen.queryByRole('listitem')).toBeNull();
  });
});
