import { create } from 'zustand';

/** The document whose window shows the command palette: a panel can be in a window of its own. */
export const usePalette = create<{ readonly page: Document | null }>(() => ({ page: null }));

export function openPalette(page: Document = document): void {
  usePalette.setState({ page });
}

export function closePalette(): void {
  usePalette.setState({ page: null });
}

export function togglePalette(page: Document = document): void {
  usePalette.setState((state) => ({ page: state.page === page ? null : page }));
}
