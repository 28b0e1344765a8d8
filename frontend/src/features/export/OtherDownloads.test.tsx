import { screen } from '@testing-library/react';
import { beforeEach, describe, expect, it, onTestFinished, vi } from 'vitest';
import { notifications } from '@mantine/notifications';
import { useProjectStore } from '@/store/project';
import { openProject, show, user } from '../../../harness/testing';
import { OtherDownloads } from './OtherDownloads';
import { paletteOf } from './palette';

interface Saved {
  readonly name: string;
  readonly blob: Blob;
}

let saved: Saved[];

beforeEach(() => {
  saved = [];
  let blob = new Blob();
  Object.assign(URL, {
    createObjectURL: (made: Blob) => {
      blob = made;
      return 'blob:1';
    },
    revokeObjectURL: () => undefined,
  });
  vi.spyOn(HTMLAnchorElement.prototype, 'click').mockImplementation(function (this: HTMLAnchorElement) {
    saved.push({ name: this.download, blob });
  });
  openProject({
    trees: {
      Main: { a: { type: 'Sequence', name: 'all' } },
      Dock: { b: { type: 'Sequence', name: 'dock it' } },
    },
  });
  onTestFinished(() => notifications.clean());
});

const button = (name: string) => screen.getByRole('button', { name });
const text = async () => (saved[0] ? await saved[0].blob.text() : '');

describe('OtherDownloads', () => {
  it.each([
    ['Project (zip)', '/api/v1/projects/p1/export'],
    ['BehaviorTree.CPP XML', '/api/v1/projects/p1/xml?self_contained=false'],
    ["XML with the actions' code", '/api/v1/projects/p1/xml?self_contained=true'],
    ['BehaviorTree.CPP 4 (C++ package)', '/api/v1/projects/p1/cpp'],
    ['Models of the nodes (palette)', '/api/v1/projects/p1/models'],
    ['XML Schema', '/api/v1/projects/p1/xsd'],
  ])('%s is a link', (name, address) => {
    show(<OtherDownloads projectId="p1" />);
    expect(screen.getByRole('link', { name })).toHaveAttribute('href', address);
    expect(screen.getByRole('link', { name })).toHaveAttribute('download');
  });

  it('writes a workflow with the tests and evaluations of the project', async () => {
    openProject({
      trees: { Main: { a: { type: 'Sequence' } } },
      texts: { 'tests/a.test.yaml': '', 'evaluations/room.yaml': '', 'evaluations/no name;.yaml': '' },
    });
    show(<OtherDownloads projectId="p1" />);
    await user.click(button('GitHub workflow'));
    expect(saved[0]?.name).toBe('trees.yml');
    expect(await text()).toContain('bt-studio test project');
    expect(await text()).toContain('evaluate project room --runs 60');
    expect(await text()).not.toContain('no name');
  });

  it('draws the tree in front, in light colours by default', async () => {
    useProjectStore.getState().setActiveTree('Dock');
    show(<OtherDownloads projectId="p1" />);
    expect(screen.getByRole('combobox', { name: 'Tree to draw' })).toHaveValue('Dock');
    await user.click(button('SVG'));
    expect(saved[0]).toMatchObject({ name: 'Dock.svg', blob: { type: 'image/svg+xml' } });
    expect(await text()).toContain('dock it');
    expect(await text()).toContain(paletteOf('light')('canvas'));
  });

  it('draws another tree in dark colours', async () => {
    useProjectStore.setState({ activeTree: null });
    show(<OtherDownloads projectId="p1" />);
    const tree = screen.getByRole('combobox', { name: 'Tree to draw' });
    expect(tree).toHaveValue('Main');
    await user.click(tree);
    await user.click(screen.getByRole('option', { name: 'Dock' }));
    await user.click(screen.getByRole('radio', { name: 'Dark' }));
    await user.click(button('SVG'));
    expect(saved[0]?.name).toBe('Dock.svg');
    expect(await text()).toContain(paletteOf('dark')('canvas'));
  });

  it('makes a PNG if the browser can', async () => {
    const png = new Blob(['png']);
    vi.stubGlobal(
      'Image',
      class {
        naturalWidth = 10;
        naturalHeight = 10;
        decode = () => Promise.resolve();
      },
    );
    onTestFinished(() => {
      vi.unstubAllGlobals();
    });
    vi.spyOn(HTMLCanvasElement.prototype, 'toBlob').mockImplementation((done) => done(png));
    show(<OtherDownloads projectId="p1" />);
    await user.click(button('PNG'));
    await vi.waitFor(() => expect(saved).toEqual([{ name: 'Main.png', blob: png }]));
  });

  it('reports that a picture could not be drawn', async () => {
    vi.stubGlobal(
      'Image',
      class {
        decode = () => Promise.reject(new Error('too large'));
      },
    );
    onTestFinished(() => {
      vi.unstubAllGlobals();
    });
    show(<OtherDownloads projectId="p1" />);
    await user.click(button('PNG'));
    expect(await screen.findByText(/SVG works for trees of any size/)).toBeInTheDocument();
    expect(saved).toEqual([]);
  });
});
