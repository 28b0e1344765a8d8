import { create } from 'zustand';

/** A finding of the language server or of ruff, by place in the text that it was made for. */
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
  /** It ended, or this server has none; `reason` is the server's sentence. */
  | { readonly kind: 'failed'; readonly reason: string; readonly willRetry: boolean };

interface LanguageData {
  readonly state: LanguageState;
  /** Findings of the language server, by path. */
  readonly findings: Readonly<Record<string, readonly CodeFinding[]>>;
}

/** The state of the language server; never saved, never undone. */
export const useLanguageStore = create<LanguageData>(() => ({ state: { kind: 'off' }, findings: {} }));
