import { screen, waitFor, within } from '@testing-library/react';
import type { ReactNode } from 'react';
import { useStore } from 'zustand';
import type { Editor } from '@/features/editor3d/editing';
import {
  editorOf as editorOfRobot,
  readingOf as readingOfRobot,
  type RobotEditor,
} from '@/features/robotEditor/editor';
import {
  editorOf as editorOfUniverse,
  readingOf as readingOfUniverse,
  type UniverseEditor,
} from '@/features/universeEditor/editor';
import robotUrdf from '@/model/robot/template/robot.urdf?raw';
import robotYaml from '@/model/robot/template/robot.yaml?raw';
import type { Robot } from '@/model/robot/types';
import type { Thing, Universe } from '@/model/universe/types';
import { useProjectStore } from '@/store/project';
import { projectDetail, projectFile } from '@/store/testing';
import { openProject, show, user } from './testing';

export const UNIVERSE = 'universes/hall.yaml';
export const ROBOT = 'robots/mine/robot.yaml';
export const URDF = 'robots/mine/robot.urdf';

/** A box of 0.4 m, a movable ball, a carpet, a person on a square way, and a robot. */
export const HALL = `format: bt-studio/universe
version: 1
name: Hall
lights: [{direction: [-0.4, 0.3, -1], intensity: 1}]
models:
  - {id: crate, shape: box, size: [0.4, 0.4, 0.4], pose: [1, 2, 0.2, 0, 0, 0], color: "#c28a52"}
  - {id: ball, shape: sphere, size: [0.12], pose: [-1, 0, 0.12, 0, 0, 0], color: "#e2543c", mass: 0.4}
  - {id: carpet, shape: plane, size: [4, 4], pose: [0, 0, 0.003, 0, 0, 0], color: "#b8c4cf", solid: false}
actors:
  - {id: walker, model: person, color: "#20c020", path: [[0, 0], [2, 0], [2, 2]], speed: 0.5, loop: true}
robots:
  - {id: robot, model: turtle2, pose: [3, 3, 0, 0, 0, 0]}
`;

let runs = 0;

/** An editor outlives its tab and belongs to one project, so each test gets a project of its own. */
function fresh<T extends Editor>(texts: Readonly<Record<string, string>>, make: () => T): T {
  openProject({ texts });
  useProjectStore.setState({ projectId: `own${(runs += 1)}` });
  return make();
}

/** Opens a project with a universe, and the universe's editor. */
export const openUniverse = (text = HALL, others: Readonly<Record<string, string>> = {}) =>
  fresh({ [UNIVERSE]: text, ...others }, () => editorOfUniverse(UNIVERSE));

/** Opens a project with a robot of our template, and the robot's editor. */
export const openRobot = (texts: Readonly<Record<string, string>> = {}) =>
  fresh({ [ROBOT]: robotYaml, [URDF]: robotUrdf, ...texts }, () => editorOfRobot(ROBOT));

/** The open project may be seen, but not changed. */
export const lookOnly = () => useProjectStore.setState({ role: 'viewer' });

interface CurrentProps<D> {
  readonly editor: Editor;
  readonly read: () => D | null;
  readonly draw: (document: D) => ReactNode;
}

/** Draws a document as it is now, also after it has changed. */
function Current<D>({ editor, read, draw }: CurrentProps<D>) {
  useProjectStore((state) => state.files);
  useStore(editor.store);
  const document = read();
  return document === null ? null : draw(document);
}

/** Shows a part of the editor of a universe, which follows the document. */
export function showUniverse(
  editor: UniverseEditor,
  draw: (universe: Universe) => ReactNode,
): { readonly thing: (id: string) => Thing | undefined; readonly universe: () => Universe } {
  const read = () => readingOfUniverse(editor).universe;
  show(<Current editor={editor} read={read} draw={draw} />);
  const universe = () => read() as Universe;
  return { universe, thing: (id) => universe().things.find((each) => each.id === id) };
}

/** Shows a part of the editor of a robot, which follows its texts. */
export function showRobot(editor: RobotEditor, draw: (robot: Robot) => ReactNode): () => Robot {
  const read = () => readingOfRobot(editor).robot;
  show(<Current editor={editor} read={read} draw={draw} />);
  return () => read() as Robot;
}

/** Writes into a field in place of what it says, at once: each key would draw it again. */
export async function type(field: HTMLElement | string, text: string): Promise<void> {
  await user.clear(typeof field === 'string' ? screen.getByTestId(field) : field);
  if (text !== '') await user.paste(text);
}

/** Writes into a field, and presses Enter. */
export async function write(field: HTMLElement | string, text: string): Promise<void> {
  await type(field, text);
  await user.keyboard('{Enter}');
}

/** Chooses from a list that opens at a field. */
export async function choose(field: HTMLElement, option: string): Promise<void> {
  await user.click(field);
  // Lists that were open before may still be on the page.
  const list = await waitFor(() => {
    const found = document.getElementById(field.getAttribute('aria-controls') ?? '');
    if (!found) throw new Error('the list is not open');
    return found;
  });
  await user.click(await within(list).findByRole('option', { name: option }));
}

/** A mesh of one triangle, so many metres wide. */
export const stl = (width: number): string =>
  `solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex ${width} 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid s\n`;

/** A mesh without a triangle; shorter files are no STL at all. */
export const EMPTY_STL = 'solid s\nendsolid s\n'.padEnd(100);

/** Answers of a server that takes a file into the open project. */
export function takesFile(path: string): Readonly<Record<string, unknown>> {
  const { projectId, files } = useProjectStore.getState();
  const present = Object.values(files).map((file) => projectFile(file.path, file.revision, file.text ?? ''));
  const own = projectId ?? '';
  const detail = {
    ...projectDetail(2, [...present, { ...projectFile(path, 2, ''), content: null }]),
    id: own,
  };
  return { [`POST /projects/${own}/changes`]: {}, [`GET /projects/${own}`]: detail };
}
