import { create } from 'zustand';

/** The dialogue that makes a behaviour test of the shown moment. */
export const useMomentTest = create<{ readonly isOpen: boolean }>(() => ({ isOpen: false }));

export const openMomentTest = () => useMomentTest.setState({ isOpen: true });
export const closeMomentTest = () => useMomentTest.setState({ isOpen: false });
