import { create } from 'zustand';

/** Whether the dialogue is open; everybody may open it. */
export const useTakeAway = create<{ isOpen: boolean }>(() => ({ isOpen: false }));

export const openTakeAway = () => useTakeAway.setState({ isOpen: true });
export const closeTakeAway = () => useTakeAway.setState({ isOpen: false });
