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
  | { readonly kind: 'ready' }
  /** The server has ended or cannot run; `reason` is its own message. */
  | { readonly kind: 'failed'; readonly reason: string; readonly willRetry: boolean };

interface LanguageData {
  readonly state: LanguageState;
  /** Findings of the language server, by path. */
  readonly findings: Readonly<Record<string, readonly CodeFinding[]>>;
}

/** The state of the language server; not saved and without undo. */
export const useLanguageStore = create<LanguageData>(() => ({ state: { kind: 'off' }, findings: {} }));
