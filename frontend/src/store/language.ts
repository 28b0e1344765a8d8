import { create } from 'zustand';

/** A finding of the language server or of ruff, with its place in the text that was checked. */
export interface CodeFinding {
  readonly from: { readonly line: number; readonly character: number };
  readonly to: { readonly line: number; readonly character: number };
  readonly severity: 'error' | 'warning' | 'info';
  readonly message: string;
  readonly source: string;
}

export type LanguageState =
  | { readonly kind: 'off' }
  | { readonly kind: 'starting' }
  /** Others get a place before it; with `isOwn` it waits until another editor of the same user ends. */
  | { readonly kind: 'waiting'; readonly before: number; readonly isOwn: boolean }
  | { readonly kind: 'ready' }
  /** The server has ended or cannot run; `reason` is the server's message. */
  | { readonly kind: 'failed'; readonly reason: string; readonly willRetry: boolean };

interface LanguageData {
  readonly state: LanguageState;
  /** The findings of the language server, by path. */
  readonly findings: Readonly<Record<string, readonly CodeFinding[]>>;
}

/** The state of the language server; it is neither saved nor undone. */
export const useLanguageStore = create<LanguageData>(() => ({ state: { kind: 'off' }, findings: {} }));
