import { actionPath } from './state';

/** The functions that open documents. Features call them here, since they cannot import the frame. */
export interface Navigator {
  openTree(id: string): void;
  /** Brings a tree to the front without the focus, unless another document than a tree is there; returns whether. */
  showTree(id: string): boolean;
  openFile(path: string, line?: number): void;
  /** Brings a file to the front and leaves the focus where it is: nobody has asked for the file. */
  showFile(path: string): void;
  /** Shows the topics of the session. */
  openTopics(): void;
  /** Moves the focus into the field of a port or script of the selected block. */
  focusField(port: string): void;
  /** Renames the tab of a tree or file. */
  renamed(kind: 'tree' | 'file', from: string, to: string): void;
  /** Moves the cursor of the editor that shows a file to a line. */
  aimAt(path: string, line: number): void;
}

let navigator: Navigator | null = null;

/** Sets the navigator; only the frame calls this. */
export function setNavigator(next: Navigator | null): void {
  navigator = next;
}

export function openTree(id: string): void {
  navigator?.openTree(id);
}

/** Brings a tree to the front, if only another tree is there; focus and other documents stay. */
export function showTree(id: string): boolean {
  return navigator?.showTree(id) ?? false;
}

export function openAction(name: string): void {
  navigator?.openFile(actionPath(name));
}

export function openFile(path: string, line?: number): void {
  navigator?.openFile(path, line);
}

export function showFile(path: string): void {
  navigator?.showFile(path);
}

export function openTopics(): void {
  navigator?.openTopics();
}

/** Moves the focus into the field of a port or script of the selected block. */
export function focusField(port: string): void {
  navigator?.focusField(port);
}

export function renamed(kind: 'tree' | 'file', from: string, to: string): void {
  navigator?.renamed(kind, from, to);
}

export function aimAt(path: string, line: number): void {
  navigator?.aimAt(path, line);
}
