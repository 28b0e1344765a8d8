/* Tests see the whole page; other tests show what the basic page leaves out. */
globalThis.localStorage?.setItem('bts.view', 'full');
