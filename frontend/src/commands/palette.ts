import { create } from 'zustand';

/** The page on which the command palette is open: a panel's own window has one, too. */
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
