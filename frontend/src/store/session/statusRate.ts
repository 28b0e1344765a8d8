import { create } from 'zustand';

/** The update rates of statuses on the canvas, in Hz; 0 means the screen's rate. */
export const STATUS_RATES = [0, 20, 10, 5, 2] as const;

const KEY = 'bts.statusRate';

function kept(): number {
  const value = Number(localStorage.getItem(KEY) ?? 0);
  return STATUS_RATES.some((rate) => rate === value) ? value : 0;
}

export const useStatusRate = create<{ hz: number }>(() => ({ hz: kept() }));

export function setStatusRate(hz: number): void {
  localStorage.setItem(KEY, String(hz));
  useStatusRate.setState({ hz });
}
