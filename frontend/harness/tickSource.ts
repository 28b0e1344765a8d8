import type { SourceCall, TickSource } from '@/generated/messages';

export const FORWARD = `class Forward:
    def update(self):
        for step in range(2):
            total = step
        self.number += 1
        if total > 5:
            return None
        return total
`;

/** A call of the code above, with what ran in it. */
export const callOf = (change: Partial<SourceCall> = {}): SourceCall => ({
  file: 'actions/Forward.py',
  function: 'Forward.update',
  line: 2,
  uid: 6,
  path: 'bump and go/Forward::6',
  part: 'tick',
  end: 'returned',
  result: '1',
  lines: [
    { line: 3, times: 3, values: [{ name: 'step', text: '1' }] },
    { line: 4, times: 2, values: [{ name: 'total', text: '1' }] },
    { line: 5, times: 1, values: [{ name: 'self.number', text: '66' }] },
    { line: 6, times: 1, values: [] },
    { line: 8, times: 1, values: [] },
  ],
  locals: [
    { name: 'step', text: '1' },
    { name: 'total', text: '1' },
  ],
  fields: [{ name: 'self.number', text: '66' }],
  ...change,
});

/** What a tick ran. */
export const sourceOf = (change: Partial<TickSource> = {}): TickSource => ({
  job: 'a1',
  t: 3.25,
  tick: 65,
  calls: [callOf()],
  files: { 'actions/Forward.py': FORWARD },
  left_out: 0,
  is_cut: false,
  differs: null,
  problem: '',
  ...change,
});
